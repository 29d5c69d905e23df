// What the renderer uploads once: which triangles meet at each vertex.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pliant::render {

struct IncidentTriangles {
  std::vector<std::uint32_t> first;                  // of each vertex in `others`, and the end: vertices + 1
  std::vector<std::array<std::uint32_t, 2>> others;  // the triangle's other two corners, in winding order
};

/// Triangles are gathered in their own order, so sums over them come out the same every time.
[[nodiscard]] IncidentTriangles incident_triangles(std::uint32_t vertex_count,
                                                   std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace pliant::render
