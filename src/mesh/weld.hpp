// Makes one vertex of vertices that (nearly) coincide, as where the patches of a model meet.
#pragma once
#include <cstddef>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

struct WeldedMesh {
  TriangleMesh mesh;
  std::size_t merged_vertex_count = 0;     // vertices that became an earlier one
  std::size_t dropped_triangle_count = 0;  // triangles left with fewer than three distinct corners
};

/// A vertex closer than `distance` [mesh units] to an earlier vertex that stays becomes the first such one, and never
/// moves it. Triangles that collapse are dropped, then vertices that no triangle uses. A distance of 0 changes nothing.
[[nodiscard]] WeldedMesh weld(const TriangleMesh& mesh, double distance);

}  // namespace pliant
