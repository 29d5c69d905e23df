// Finds the triangles around each vertex.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pliant {

struct IncidentTriangles {
  std::vector<std::uint32_t> first;                  // [vertex + 1] where each vertex's triangles begin in `others`
  std::vector<std::array<std::uint32_t, 2>> others;  // the triangle's other two corners, in winding order
};

/// Returns each vertex's triangles in their own order, so that sums over them come out the same every time.
[[nodiscard]] IncidentTriangles incident_triangles(std::uint32_t vertex_count,
                                                   std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace pliant
