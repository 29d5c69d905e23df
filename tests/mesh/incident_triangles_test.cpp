// Which triangles meet at each vertex.
#include "mesh/incident_triangles.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "mesh/generators.hpp"

using namespace pliant;

TEST_CASE("every triangle is found at each of its corners, with the others in winding order") {
  const TriangleMesh mesh = generate_mesh("icosphere:2");
  const auto vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  const auto around = incident_triangles(vertex_count, mesh.triangles);
  REQUIRE(around.first.size() == vertex_count + 1);
  REQUIRE(around.first.back() == mesh.triangles.size() * 3);
  std::vector<std::array<std::uint32_t, 3>> found;
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    for (std::uint32_t i = around.first[v]; i < around.first[v + 1]; ++i)
      found.push_back({v, around.others[i][0], around.others[i][1]});
  }
  std::vector<std::array<std::uint32_t, 3>> expected;
  for (const auto& [a, b, c] : mesh.triangles) expected.insert(expected.end(), {{a, b, c}, {b, c, a}, {c, a, b}});
  std::ranges::sort(found);
  std::ranges::sort(expected);
  CHECK(found == expected);
}

TEST_CASE("a vertex in no triangle has an empty range") {
  const std::array<std::uint32_t, 3> triangle[] = {{0, 1, 3}};
  CHECK(incident_triangles(5, triangle).first == std::vector<std::uint32_t>{0, 1, 2, 2, 3, 3});
  CHECK(incident_triangles(0, {}).first == std::vector<std::uint32_t>{0});
}
