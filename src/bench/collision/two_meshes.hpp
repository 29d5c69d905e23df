// What all engines of the suite `collision` search: two meshes where they stand.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace pliant::bench {

using Triangle = std::array<std::uint32_t, 3>;  // vertices

struct TwoMeshes {
  std::vector<glm::vec4> positions;  // of the vertices of both; w: 1 [m]
  std::vector<Triangle> triangles;   // those of the first, then those of the second
  std::uint32_t first_count = 0;     // triangles of the first

  [[nodiscard]] std::span<const Triangle> first() const { return std::span(triangles).first(first_count); }
  [[nodiscard]] std::span<const Triangle> second() const { return std::span(triangles).subspan(first_count); }
  [[nodiscard]] glm::vec4 corner(std::uint32_t triangle, std::uint32_t k) const { return positions[triangles[triangle][k]]; }
};

/// Two triangles, one of the first mesh and one of the second, both as indices in `triangles`.
using TrianglePairs = std::vector<glm::uvec2>;

}  // namespace pliant::bench
