#include "bench/common/shapes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/generators.hpp"

namespace pliant::bench {
namespace {

TEST_CASE("points on the spiral are evenly spread over the unit sphere") {
  const TriangleMesh mesh = spiral_sphere(1000);
  REQUIRE(mesh.positions.size() == 1000);
  glm::dvec3 sum(0.0);
  double nearest = 4;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    CHECK(glm::length(mesh.positions[i]) == Approx(1));
    sum += mesh.positions[i];
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, glm::distance(mesh.positions[i], mesh.positions[j]));
  }
  CHECK(glm::length(sum) < 1);
  CHECK(nearest > 0.7 * std::sqrt(4 * std::numbers::pi / 1000));  // in a square lattice the factor is 1
}

TEST_CASE("every vertex of a deformed body moves by up to a few percent, each differently") {
  const ModelAndState body = deformed_body(generate_mesh("icosphere:2"));
  glm::dvec3 before(0.0);
  for (std::size_t i = 0; i < body.model.rest_positions.size(); ++i) {
    const glm::dvec3 moved(body.state.motion[6 * i], body.state.motion[6 * i + 1], body.state.motion[6 * i + 2]);
    CHECK(glm::length(moved) < 0.06);
    CHECK(moved != before);
    before = moved;
  }
}

}  // namespace
}  // namespace pliant::bench
