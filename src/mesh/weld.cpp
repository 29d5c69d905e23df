// Uses a hash grid with cells as wide as the distance. Vertices that may become one stand in the same cell or in neighbours.
#include "mesh/weld.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <optional>
#include <unordered_map>

#include "core/expect.hpp"
#include "mesh/compact.hpp"

namespace pliant {
namespace {

using Cell = glm::dvec3;  // whole numbers, held as doubles because a tiny distance makes them too large for integers

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    const std::hash<double> hash;
    return (hash(cell.x) * 31 + hash(cell.y)) * 31 + hash(cell.z);
  }
};

class WeldGrid {
 public:
  WeldGrid(const std::vector<glm::dvec3>& positions, double distance) : positions_(positions), distance_(distance) {}

  /// Returns the first vertex that stays and is closer than the distance. If there is none, `vertex` itself stays.
  std::uint32_t find_or_add(std::uint32_t vertex) {
    const Cell centre = cell_of(positions_[vertex]);
    std::optional<std::uint32_t> first;
    for (int i = 0; i < 27; ++i) {
      const auto found = first_in(centre + Cell(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), positions_[vertex]);
      if (found && (!first || *found < *first)) first = found;
    }
    if (first) return *first;
    cells_[centre].push_back(vertex);
    return vertex;
  }

 private:
  [[nodiscard]] Cell cell_of(const glm::dvec3& position) const {
    return {std::floor(position.x / distance_), std::floor(position.y / distance_), std::floor(position.z / distance_)};
  }

  [[nodiscard]] std::optional<std::uint32_t> first_in(const Cell& cell, const glm::dvec3& position) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return std::nullopt;
    for (const std::uint32_t vertex : found->second)
      if (glm::distance(positions_[vertex], position) < distance_) return vertex;
    return std::nullopt;
  }

  const std::vector<glm::dvec3>& positions_;
  double distance_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

bool collapsed(const std::array<std::uint32_t, 3>& triangle) {
  return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

}  // namespace

WeldedMesh weld(const TriangleMesh& mesh, double distance) {
  PLIANT_EXPECT(distance >= 0);
  WeldedMesh welded{mesh};
  if (distance == 0) return welded;

  WeldGrid grid(mesh.positions, distance);
  std::vector<std::uint32_t> target(mesh.positions.size());
  for (std::uint32_t vertex = 0; vertex < target.size(); ++vertex) {
    target[vertex] = grid.find_or_add(vertex);
    if (target[vertex] != vertex) ++welded.merged_vertex_count;
  }
  for (auto& triangle : welded.mesh.triangles)
    for (std::uint32_t& vertex : triangle) vertex = target[vertex];
  welded.dropped_triangle_count = std::erase_if(welded.mesh.triangles, collapsed);
  remove_unused_vertices(welded.mesh);
  return welded;
}

}  // namespace pliant
