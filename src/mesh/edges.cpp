// Sorts sides by their lower vertex with a counting sort. Then it sorts the few sides of each vertex by their higher one.
#include "mesh/edges.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/expect.hpp"

namespace pliant {
namespace {

struct SideAtVertex {
  std::uint32_t high, side;  // its higher vertex, and its number

  bool operator<(const SideAtVertex& other) const { return high != other.high ? high < other.high : side < other.side; }
};

/// Calls visit(side, lower vertex, higher vertex) for every side with two ends.
template <typename Visit>
void for_each_side(const TriangleMesh& mesh, const Visit& visit) {
  std::uint32_t side = 0;
  for (const auto& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair(t[0], t[1]), std::pair(t[1], t[2]), std::pair(t[2], t[0])}) {
      if (a != b) visit(side, std::min(a, b), std::max(a, b));
      ++side;
    }
}

/// Sets each side's entry to the first side of its edge.
void find_first_sides(const TriangleMesh& mesh, std::vector<std::uint32_t>& first_of_side) {
  std::vector<std::uint32_t> first(mesh.positions.size() + 1, 0);  // [vertex + 1] where its sides begin in `sides`
  for_each_side(mesh, [&](std::uint32_t, std::uint32_t low, std::uint32_t) { ++first[low + std::size_t{1}]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<SideAtVertex> sides(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for_each_side(mesh, [&](std::uint32_t side, std::uint32_t low, std::uint32_t high) { sides[next[low]++] = {high, side}; });
  for (std::size_t vertex = 0; vertex + 1 < first.size(); ++vertex) {
    const auto begin = sides.begin() + first[vertex], end = sides.begin() + first[vertex + 1];
    std::sort(begin, end);
    for (auto side = begin; side != end; ++side)
      first_of_side[side->side] = side != begin && side[-1].high == side->high ? first_of_side[side[-1].side] : side->side;
  }
}

}  // namespace

Edges find_edges(const TriangleMesh& mesh) {
  PLIANT_EXPECT(mesh.triangles.size() < std::numeric_limits<std::uint32_t>::max() / 3);
  Edges edges;
  edges.of_side.assign(3 * mesh.triangles.size(), no_edge);
  find_first_sides(mesh, edges.of_side);
  for (std::uint32_t side = 0; side < edges.of_side.size(); ++side) {
    std::uint32_t& edge = edges.of_side[side];
    if (edge == no_edge) continue;
    if (edge == side) {
      edge = static_cast<std::uint32_t>(edges.first_side.size());
      edges.first_side.push_back(side);
    } else {
      edge = edges.of_side[edge];
    }
  }
  return edges;
}

}  // namespace pliant
