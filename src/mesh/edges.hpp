// Numbers the edges of a mesh, in time and memory that grow with its triangles.
#pragma once
#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Side 3 t + k of a mesh leads from corner k of triangle t to the next one. Sides with the same two vertices are one edge.
struct Edges {
  std::vector<std::uint32_t> of_side;     // [side] its edge, or no_edge if both its ends are one vertex
  std::vector<std::uint32_t> first_side;  // [edge] the first of its sides, so edges count by their first appearance

  [[nodiscard]] std::size_t count() const { return first_side.size(); }
};

inline constexpr std::uint32_t no_edge = 0xffffffff;

/// Returns the side behind this one in its triangle, which begins where this one ends.
[[nodiscard]] constexpr std::uint32_t next_side(std::uint32_t side) { return side % 3 == 2 ? side - 2 : side + 1; }

/// Returns the vertex in which a side begins.
[[nodiscard]] inline std::uint32_t start_of_side(const TriangleMesh& mesh, std::uint32_t side) {
  return mesh.triangles[side / 3][side % 3];
}

/// Expects fewer than 2^32 / 3 triangles.
[[nodiscard]] Edges find_edges(const TriangleMesh& mesh);

}  // namespace pliant
