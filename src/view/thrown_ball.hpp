// A ball that the viewer throws.
#pragma once
#include "model/model.hpp"
#include "view/pick.hpp"

namespace pliant::view {

/// Returns a ball before the ray's origin that flies along the ray. Its size and speed suit a scene of that radius [m]. Its
/// stiffest frequency and its damping rate are those of the first soft body, so that it asks for no shorter steps. `gravity` is
/// that of the world [m/s^2].
[[nodiscard]] BodySetup ball_to_throw(const Model& model, double scene_radius, const Ray& ray, const glm::dvec3& gravity);

}  // namespace pliant::view
