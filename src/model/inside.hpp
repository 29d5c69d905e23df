// Whether a point is inside a body, or enclosed by it.
#pragma once
#include "model/model.hpp"

namespace pliant {

/// Returns whether the body's triangles fill more than half of all directions as seen from the point. For a closed body that is
/// inside. `positions` are those of the model's vertices in the world [m]. Takes the time of a loop over the body's triangles.
[[nodiscard]] bool is_inside(const glm::dvec3& point, const Model& model, const ModelBody& body,
                             std::span<const glm::dvec3> positions);
/// Returns whether the body's triangles fill all directions, but for a hundredth. A bowl does not.
[[nodiscard]] bool is_enclosed(const glm::dvec3& point, const Model& model, const ModelBody& body,
                               std::span<const glm::dvec3> positions);

}  // namespace pliant
