// Merges vertices that coincide or nearly do, as where the patches of a model meet.
#pragma once
#include <cstddef>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

struct WeldedMesh {
  TriangleMesh mesh;
  std::size_t merged_vertex_count = 0;     // vertices that became an earlier one
  std::size_t dropped_triangle_count = 0;  // triangles left with fewer than three distinct corners
};

/// Merges each vertex into the first earlier vertex that stays and is closer than `distance` [mesh units]. The one that stays
/// does not move. Then drops triangles that collapsed, and vertices that no triangle uses. A distance of 0 changes nothing.
[[nodiscard]] WeldedMesh weld(const TriangleMesh& mesh, double distance);

}  // namespace pliant
