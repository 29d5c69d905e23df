#include "collision/contacts/oracle.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "collision/contacts/degenerate_cases.hpp"

namespace pliant::testing {
namespace {

bool before(const glm::uvec2& p, const glm::uvec2& q) { return p.x != q.x ? p.x < q.x : p.y < q.y; }

std::vector<glm::uvec2> pairs_of(const Model& model) {
  return intersecting_pairs(model, model.rest_positions, TriangleTest::certified);
}

Triangle corners(const Model& model, std::uint32_t triangle) {
  Triangle result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = glm::vec3(model.rest_positions[model.triangles[triangle][k]]);
  return result;
}

/// The same body once more at another place.
void add_copy(Model& model, std::size_t original, const glm::vec3& shift) {
  ModelBody body = model.bodies[original];
  const std::uint32_t first_vertex = model.vertex_count(), first_triangle = static_cast<std::uint32_t>(model.triangles.size());
  for (std::uint32_t i = 0; i < body.vertex_count; ++i) {
    model.rest_positions.push_back(model.rest_positions[body.first_vertex + i] + glm::vec4(shift, 0.0f));
  }
  for (std::uint32_t i = 0; i < body.triangle_count; ++i) {
    auto moved = model.triangles[body.first_triangle + i];
    for (std::uint32_t& vertex : moved) vertex = vertex - body.first_vertex + first_vertex;
    model.triangles.push_back(moved);
  }
  body.first_vertex = first_vertex;
  body.first_triangle = first_triangle;
  model.bodies.push_back(body);
}

}  // namespace

TEST_CASE("cubes in contact: every touching pair is found, and others only nearer than rounding can tell") {
  for (const CubePair& cubes : cube_pairs()) {
    INFO(cubes.id);
    const std::vector<glm::uvec2> found = pairs_of(cubes.model);
    CHECK(std::is_sorted(found.begin(), found.end(), before));
    CHECK(std::includes(found.begin(), found.end(), cubes.pairs.begin(), cubes.pairs.end(), before));
    for (const glm::uvec2& pair : found) {
      if (std::binary_search(cubes.pairs.begin(), cubes.pairs.end(), pair, before)) continue;
      CHECK(relative_gap(corners(cubes.model, pair.x), corners(cubes.model, pair.y)) < 1e-5);
    }
  }
}

TEST_CASE("Möller's test finds the pairs of cubes that cross") {
  for (const CubePair& cubes : cube_pairs()) {
    if (cubes.id != "cubes-cross") continue;
    CHECK(intersecting_pairs(cubes.model, cubes.model.rest_positions, TriangleTest::moller) == cubes.pairs);
  }
}

TEST_CASE("pairs of three bodies are sorted, and no pair lies within one body") {
  Model model = cube_pairs().front().model;
  add_copy(model, 0, glm::vec3(0.5f, 0.25f, 0.125f));  // reaches into both
  const std::vector<glm::uvec2> pairs = pairs_of(model);
  CHECK(std::is_sorted(pairs.begin(), pairs.end(), before));
  CHECK(std::adjacent_find(pairs.begin(), pairs.end()) == pairs.end());
  std::array<int, 3> met{};  // bodies 0 and 1, 0 and 2, 1 and 2
  for (const glm::uvec2& pair : pairs) {
    REQUIRE(pair.x / 12 < pair.y / 12);
    ++met[pair.x / 12 + pair.y / 12 - 1];
  }
  CHECK(std::all_of(met.begin(), met.end(), [](int count) { return count > 0; }));
}

TEST_CASE("bodies far apart have no pairs") {
  Model model = cube_pairs().front().model;
  for (std::uint32_t i = 0; i < model.bodies[1].vertex_count; ++i) {
    model.rest_positions[model.bodies[1].first_vertex + i].x += 10.0f;
  }
  CHECK(pairs_of(model).empty());
}

}  // namespace pliant::testing
