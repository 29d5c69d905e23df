#include "mesh/edges.hpp"

#include <algorithm>
#include <map>
#include <random>

#include "mesh/generators.hpp"

namespace pliant {
namespace {

/// The oracle: numbers edges by a map, in the order of sides.
Edges edges_by_map(const TriangleMesh& mesh) {
  Edges edges;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
  for (std::uint32_t side = 0; side < 3 * mesh.triangles.size(); ++side) {
    const std::uint32_t a = start_of_side(mesh, side), b = start_of_side(mesh, next_side(side));
    if (a == b) {
      edges.of_side.push_back(no_edge);
      continue;
    }
    const auto [entry, is_new] = numbers.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(numbers.size()));
    if (is_new) edges.first_side.push_back(side);
    edges.of_side.push_back(entry->second);
  }
  return edges;
}

void check_edges(const TriangleMesh& mesh) {
  const Edges edges = find_edges(mesh), expected = edges_by_map(mesh);
  CHECK(edges.of_side == expected.of_side);
  CHECK(edges.first_side == expected.first_side);
}

}  // namespace

TEST_CASE("edges of a closed mesh are numbered as their first sides are met") {
  check_edges(generate_mesh("icosphere:3"));
  check_edges(generate_mesh("bowl:4"));
  CHECK(find_edges(generate_mesh("icosphere:3")).count() == 3 * 642 - 6);
}

TEST_CASE("edges of any triangles are found, also where they have one side, three or none") {
  const unsigned seed = 4711;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 100; ++round) {
    TriangleMesh mesh;
    mesh.positions.resize(1 + random() % 12);
    const auto corner = [&] { return static_cast<std::uint32_t>(random() % mesh.positions.size()); };
    for (std::size_t t = random() % 40; t > 0; --t) mesh.triangles.push_back({corner(), corner(), corner()});
    check_edges(mesh);
  }
  check_edges({});
}

}  // namespace pliant
