// Computes from a body's mesh what its pressure needs.
#pragma once
#include "model/model.hpp"

namespace pliant {

/// A body's volume at a shape, with what a force by pressure needs of its derivatives.
struct VolumeAt {
  double volume = 0;            // [m^3]
  double gradient_squared = 0;  // summed over the vertices [m^4]
  double curvature = 0;         // at least the norm of the second derivative [m]
};

/// Returns the volume that the body's triangles enclose [m^3]. `positions` are those of the body's vertices, in its frame or any
/// other [m].
[[nodiscard]] double volume_of(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions);
/// `positions` are those of the body's vertices, in its frame [m].
[[nodiscard]] VolumeAt volume_at(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions);

/// Returns the inflation of `body`. Expects its rest positions and triangles to be the model's last. Throws Error (input) if the
/// mesh is open, not wound outward or flat.
[[nodiscard]] Inflation inflate(const BodySetup& setup, const Model& model, const ModelBody& body);

}  // namespace pliant
