// Uses a hash grid. Its cells are wider than the distance, so that most vertices have all their candidates in one cell. Cells
// with the same hash share a list, because a candidate is judged by its distance alone.
#include "mesh/weld.hpp"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/expect.hpp"
#include "mesh/compact.hpp"
#include "mesh/position_hash.hpp"

namespace pliant {
namespace {

using Cell = glm::dvec3;  // whole numbers, held as doubles because a tiny distance makes them too large for integers

class WeldGrid {
 public:
  WeldGrid(const std::vector<glm::dvec3>& positions, double distance)
      : positions_(positions),
        distance_(distance),
        latest_(std::bit_ceil(positions.size() + 1), none),
        before_(positions.size()) {}

  /// Returns the first vertex that stays and is closer than the distance. If there is none, `vertex` itself stays.
  std::uint32_t find_or_add(std::uint32_t vertex) {
    const glm::dvec3 &position = positions_[vertex], reach(distance_ * (1 + 1e-12));  // a distance rounds to less than it is
    const Cell lowest = cell_of(position - reach), own = cell_of(position), highest = cell_of(position + reach);
    std::uint32_t first = none;
    for_each_of(lowest.x, own.x, highest.x, [&](double x) {
      for_each_of(lowest.y, own.y, highest.y, [&](double y) {
        for_each_of(lowest.z, own.z, highest.z, [&](double z) { first = std::min(first, first_in({x, y, z}, position)); });
      });
    });
    if (first != none) return first;
    before_[vertex] = std::exchange(latest_[list_of(own)], vertex);
    return vertex;
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  template <typename Visit>
  static void for_each_of(double lowest, double own, double highest, const Visit& visit) {
    visit(own);
    if (lowest != own) visit(lowest);
    if (highest != own) visit(highest);
  }

  [[nodiscard]] Cell cell_of(const glm::dvec3& position) const { return glm::floor(position / (4 * distance_)); }
  [[nodiscard]] std::size_t list_of(const Cell& cell) const { return hash_of(cell) & (latest_.size() - 1); }

  [[nodiscard]] std::uint32_t first_in(const Cell& cell, const glm::dvec3& position) const {
    std::uint32_t first = none;
    for (std::uint32_t vertex = latest_[list_of(cell)]; vertex != none; vertex = before_[vertex])
      if (glm::distance(positions_[vertex], position) < distance_) first = vertex;  // lists lead from later to earlier ones
    return first;
  }

  const std::vector<glm::dvec3>& positions_;
  double distance_;
  std::vector<std::uint32_t> latest_;  // [list] the vertex that was added last
  std::vector<std::uint32_t> before_;  // [vertex] the one before it in its list
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
