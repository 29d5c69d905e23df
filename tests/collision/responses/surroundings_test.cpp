// What lies around triangles, against a search through all of them.
#include "collision/responses/surroundings.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "support/evolve.hpp"

namespace pliant {
namespace {

using Corners = std::array<std::uint32_t, 3>;

// The third vertices of all triangles at each edge.
std::map<std::set<std::uint32_t>, std::vector<std::uint32_t>> thirds_at_edges(const std::vector<Corners>& triangles) {
  std::map<std::set<std::uint32_t>, std::vector<std::uint32_t>> thirds;
  for (const Corners& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) thirds[{t[k], t[(k + 1) % 3]}].push_back(t[(k + 2) % 3]);
  return thirds;
}

void check_surroundings(const std::vector<Corners>& triangles, std::uint32_t first_vertex, std::uint32_t vertex_count) {
  const std::vector<std::uint32_t> around = surroundings(triangles, first_vertex, vertex_count);
  REQUIRE(around.size() == 4 * triangles.size());
  const auto thirds = thirds_at_edges(triangles);
  std::map<std::uint32_t, int> vertex_owners;
  std::map<std::set<std::uint32_t>, int> edge_owners;
  std::set<std::uint32_t> vertices;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      CAPTURE(t, k);
      const std::uint32_t vertex = triangles[t][k], third = triangles[t][(k + 2) % 3], owned = around[4 * t + 3];
      const std::set<std::uint32_t> edge = {vertex, triangles[t][(k + 1) % 3]};
      vertices.insert(vertex);
      if ((owned >> k & 1) != 0) ++vertex_owners[vertex];
      if ((owned >> (3 + k) & 1) != 0) ++edge_owners[edge];
      std::vector<std::uint32_t> others = thirds.at(edge);
      others.erase(std::ranges::find(others, third));
      CHECK(around[4 * t + k] == (others.size() == 1 ? others.front() - first_vertex : physics::no_vertex));
    }
  CHECK(vertex_owners.size() == vertices.size());
  CHECK(edge_owners.size() == thirds.size());
  for (const auto& [vertex, owners] : vertex_owners) CHECK(owners == 1);
  for (const auto& [edge, owners] : edge_owners) CHECK(owners == 1);
}

TEST_CASE("each vertex and edge belongs to one triangle, and the one across an edge is told if there is just one") {
  check_surroundings(generate_mesh("icosphere:1").triangles, 0, 42);
  check_surroundings({{5, 6, 7}, {6, 5, 8}, {5, 6, 9}, {9, 6, 10}, {12, 11, 13}}, 5, 9);  // three meet at one edge
}

TEST_CASE("bodies of one mesh share what surrounds their triangles, and others have their own") {
  std::vector<BodySetup> setups = {sphere(1), sphere(0), sphere(1)};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  const Forest forest = build_forest(start.model, start.model.rest_positions, {});
  std::vector<physics::Surface> surfaces(3);
  const std::vector<std::uint32_t> around = surroundings_of(start.model, forest, surfaces);
  CHECK(around.size() == 4 * (setups[0].mesh.triangles.size() + setups[1].mesh.triangles.size()));
  for (std::size_t b = 0; b < 3; ++b) {
    const ModelBody& body = start.model.bodies[b];
    const std::vector<std::uint32_t> own = surroundings(
        std::span(forest.triangles).subspan(body.first_triangle, body.triangle_count), body.first_vertex, body.vertex_count);
    const std::uint32_t first = 4 * (body.first_triangle + surfaces[b].to_mesh);
    REQUIRE(first + own.size() <= around.size());
    CHECK(std::equal(own.begin(), own.end(), around.begin() + first));
  }
}

}  // namespace
}  // namespace pliant
