// Contact by impulses. Before a step, velocities are kicked so that no features come nearer than a gap. After it, each motion is
// proven to stay apart from its neighbours', or is cut short. docs/contact.md explains the method.
#pragma once
#include "collision/responses/response.hpp"
#include "model/model.hpp"
#include "physics/contact/surface.glsl"

namespace pliant {

/// Returns what contacts know of a body, but for its bound on steps, which takes the law of damping, and its nearness, which takes
/// all bodies. Both are 0.
[[nodiscard]] physics::Surface surface_of(const Model& model, const ModelBody& body, const CollisionDescription& description);
/// Returns what they know of a ground.
[[nodiscard]] physics::Ground ground_of(const Ground& ground, const CollisionDescription& description);

/// How a step's surplus is foreseen (physics/contact/surplus.glsl): how much counts of what its end's surplus and its lead have
/// changed by.
struct Foresight {
  double share_of_end, share_of_lead;
};
/// For methods that move as springs do. Vertices that stick to a ground gain nothing in steps of up to 0.75 / omega, and up to
/// 9e-5 a step at 0.8 / omega. With a larger share of the end columns settle sooner, and bodies gain more.
constexpr Foresight foresight_of_most_methods = {0.6, 1};
/// For Verlet's method. Leads are due to damping alone there. With a larger share of the end heaps rest later.
constexpr Foresight foresight_with_forces_at_ends = {0.5, 0};

[[nodiscard]] ResponseRow impulse_row();

}  // namespace pliant
