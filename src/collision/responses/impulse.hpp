// Contact by impulses. Before a step, velocities are kicked so that no features come nearer than a gap. After it, each motion is
// proven to stay apart from its neighbours', or is cut short. docs/contact.md explains the method.
#pragma once
#include "collision/responses/response.hpp"
#include "model/model.hpp"
#include "physics/contact/surface.glsl"

namespace pliant {

/// Returns what contacts know of a body, but for its nearness, which takes all bodies.
[[nodiscard]] physics::Surface surface_of(const Model& model, const ModelBody& body, const CollisionDescription& description);
/// Returns what they know of a ground.
[[nodiscard]] physics::Ground ground_of(const Ground& ground, const CollisionDescription& description);

[[nodiscard]] ResponseRow impulse_row();

}  // namespace pliant
