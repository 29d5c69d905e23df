// Bodies of any density for measurements.
#pragma once
#include <cstdint>

#include "mesh/triangle_mesh.hpp"
#include "model/model.hpp"

namespace pliant::bench {

/// Points spread evenly over the unit sphere along a spiral (a Fibonacci lattice), without triangles.
[[nodiscard]] TriangleMesh spiral_sphere(std::uint32_t vertex_count);

/// Every triangle split in four at its edges' middles, which stay where they are: the same surface with four times the triangles.
[[nodiscard]] TriangleMesh split_in_four(const TriangleMesh& mesh);

/// One body at rest whose vertices are a few percent of its size off their rest positions, each by an amount of its own.
[[nodiscard]] ModelAndState deformed_body(TriangleMesh mesh);

}  // namespace pliant::bench
