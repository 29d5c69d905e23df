// A ball that the viewer throws.
#pragma once
#include "model/model.hpp"
#include "view/pick.hpp"

namespace pliant::view {

/// Returns the radius of the sphere around all bodies at the start [m].
[[nodiscard]] double scene_radius(const Model& model, const State& start);

/// Returns a ball before the ray's origin that flies along the ray. Its size and speed suit the scene. Its stiffest frequency and
/// its damping rate are those of the first soft body, so that it asks for no shorter steps. `gravity` is that of the world
/// [m/s^2].
[[nodiscard]] BodySetup ball_to_throw(const Model& model, const State& start, const Ray& ray, const glm::dvec3& gravity);

}  // namespace pliant::view
