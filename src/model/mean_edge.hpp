// The mean length of a mesh's edges, by which contacts measure distances.
#pragma once
#include "model/model.hpp"

namespace pliant {

/// Returns the mean over the sides of the body's triangles at rest [m]. Expects a triangle.
[[nodiscard]] double mean_edge(const Model& model, const ModelBody& body);

}  // namespace pliant
