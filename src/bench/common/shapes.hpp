// Makes bodies of any density for measurements.
#pragma once
#include <cstdint>

#include "mesh/triangle_mesh.hpp"
#include "model/model.hpp"

namespace pliant::bench {

/// Returns points spread evenly over the unit sphere along a spiral (a Fibonacci lattice), without triangles.
[[nodiscard]] TriangleMesh spiral_sphere(std::uint32_t vertex_count);

/// Returns a body without velocity. Each vertex is off its rest position by its own amount, a few percent of the body's size.
[[nodiscard]] ModelAndState deformed_body(TriangleMesh mesh);

}  // namespace pliant::bench
