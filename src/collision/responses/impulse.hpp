// Contact by impulses. Before a step, velocities are kicked so that no features come nearer than a gap. After it, each motion is
// proven to stay apart from its neighbours', or is cut short. docs/contact.md explains the method.
#pragma once
#include "collision/responses/response.hpp"
#include "model/model.hpp"
#include "physics/contact/surface.glsl"

namespace pliant {

/// Returns what contacts know of a body. Its steps have no bound yet, which takes the law of damping. Its nearness and `to_mesh`
/// are 0, which take all bodies.
[[nodiscard]] physics::Surface surface_of(const Model& model, const ModelBody& body, const CollisionDescription& description);
/// Returns what they know of a ground.
[[nodiscard]] physics::Ground ground_of(const Ground& ground, const CollisionDescription& description);

/// The two shares of the formula for S in docs/contact.md.
struct Foresight {
  double share_of_end;   // p: how much of the change of the end's surplus counts
  double share_of_lead;  // q: how much of the change of the lead counts
};
/// For methods that move as springs do. Bodies of which a part sticks to a ground gain nothing in steps of up to 0.75 / omega,
/// and up to 9e-5 of their amplitude a step at 0.8 / omega. With a larger share of the end columns settle sooner, and bodies gain
/// more.
constexpr Foresight foresight_of_most_methods = {0.6, 1};
/// For Verlet's method. Leads are due to damping alone there. With a larger share of the end heaps rest later.
constexpr Foresight foresight_with_forces_at_ends = {0.5, 0};

[[nodiscard]] ResponseRow impulse_row();

}  // namespace pliant
