// Pressure inside closed bodies: physics/forces/pressure.glsl.
#pragma once
#include "dynamics/forces/force.hpp"

namespace pliant {

[[nodiscard]] Force pressure();

/// Returns the volume that a body's triangles enclose [m^3]. `positions` are in the body's frame or any other.
[[nodiscard]] double volume_of(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions);

}  // namespace pliant
