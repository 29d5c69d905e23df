// Pressure inside closed bodies: physics/forces/pressure.glsl.
#pragma once
#include "dynamics/forces/force.hpp"

namespace pliant {

[[nodiscard]] Force pressure();

/// That a body's triangles enclose, in its frame or any other [m^3].
[[nodiscard]] double volume_of(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions);

}  // namespace pliant
