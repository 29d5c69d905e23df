// The rigid motion of a body that may be deformed.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "model/model.hpp"

namespace pliant {

struct BodyMotion {
  glm::dvec3 centre{0.0};    // of the vertices [m]
  glm::dquat rotation{};     // from the rest shape
  glm::dvec3 velocity{0.0};  // of the centre [m/s]
  glm::dvec3 spin{0.0};      // [rad/s]
};

/// Returns the motion without deformation that has the body's momentum and, in its present shape, its angular momentum. With this
/// spin the rest shape has another one. Its rotation is the one that brings
/// the rest shape nearest to the vertices, by least squares (W. Kabsch, 1976).
[[nodiscard]] BodyMotion body_motion(const Model& model, const State& state, std::size_t body);

}  // namespace pliant
