// How bodies lie in each other, and the way out.
#include "simulation/overlap.hpp"

#include <catch2/catch.hpp>

#include "bench/contact/apart.hpp"
#include "support/evolve.hpp"

namespace pliant {
namespace {

// A cube of side 1 at the origin, and others of these sides at these places.
ModelAndState cubes(std::initializer_list<std::pair<double, glm::dvec3>> others) {
  std::vector<BodySetup> setups = {body_of_mesh(generate_mesh("cube:2"))};
  for (const auto& [side, place] : others) {
    BodySetup& setup = setups.emplace_back(body_of_mesh(generate_mesh("cube:2")));
    setup.description.scale = side;
    setup.description.position = place;
  }
  return build_model(setups, glm::dvec3(0.0));
}

std::vector<glm::dvec3> moved(const Model& model, std::vector<glm::dvec3> positions, const Overlap& overlap) {
  const ModelBody& body = model.bodies[overlap.second];
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i) positions[i] += overlap.way_out;
  return positions;
}

std::size_t not_apart(const Model& model, const std::vector<glm::dvec3>& positions) {
  return bench::ApartOracle(model).pairs_not_apart(positions);
}

TEST_CASE("the depth is that of the deepest vertex, and the way out parts the bodies") {
  const ModelAndState start = cubes({{0.5, {0.6, 0.02, 0}}});  // its corners are 0.15 m deep
  const std::vector<glm::dvec3> positions = start.state.world_positions(start.model);
  const Overlap overlap = find_overlap(start.model, positions, {}, 64).value();
  CHECK(overlap.first == 0);
  CHECK(overlap.second == 1);
  CHECK(overlap.depth == Approx(0.15).epsilon(1e-6));
  CHECK(overlap.way_out.x ==
        Approx(0.15 + gap_between(start.model, start.model.bodies[0], start.model.bodies[1], {})).epsilon(1e-6));
  CHECK(not_apart(start.model, positions) > 0);
  CHECK(not_apart(start.model, moved(start.model, positions, overlap)) == 0);
}

TEST_CASE("of several bodies the two that are deepest in each other are named") {
  const ModelAndState start = cubes({{0.5, {0.7, 0.02, 0}}, {0.5, {-0.6, 0.02, 0}}, {0.5, {0, 0.73, 0}}});
  const Overlap overlap = find_overlap(start.model, start.state.world_positions(start.model), {}, 64).value();
  CHECK(overlap.first == 0);
  CHECK(overlap.second == 2);
  CHECK(overlap.depth == Approx(0.15).epsilon(1e-6));
}

BodySetup triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& shift) {
  return body_of_mesh({{a + shift, b + shift, c + shift}, {{0, 1, 2}}});
}

// Two large triangles side by side, upright and slanted to the axes, so that their boxes overlap. A small one crosses each of
// them.
TEST_CASE("only bodies that intersect are named, though the boxes of others overlap") {
  const glm::dvec3 aside(1, 0, 0);
  std::vector<BodySetup> setups;
  for (const glm::dvec3& shift : {glm::dvec3(0.0), aside}) setups.push_back(triangle({0, 0, 0}, {4, 4, 0}, {2, 2, 4}, shift));
  const ModelAndState apart = build_model(setups, glm::dvec3(0.0));
  for (const glm::dvec3& shift : {glm::dvec3(0.0), aside})
    setups.push_back(triangle({1.8, 2.2, 1}, {2.2, 1.8, 1}, {2.15, 1.95, 1.5}, shift));
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  REQUIRE(not_apart(start.model, start.state.world_positions(start.model)) == 2);
  CHECK_FALSE(find_overlap(apart.model, apart.state.world_positions(apart.model), {}, 64).has_value());
  const Overlap overlap = find_overlap(start.model, start.state.world_positions(start.model), {}, 64).value();
  CHECK(overlap.second == overlap.first + 2);
  CHECK(overlap.depth == 0);
  for (BodySetup& setup : setups) setup.description.kind = BodyKind::immovable;  // these may intersect
  const ModelAndState still = build_model(setups, glm::dvec3(0.0));
  CHECK_FALSE(find_overlap(still.model, still.state.world_positions(still.model), {}, 64).has_value());
}

// Looking at all pairs would take longer than a test may.
TEST_CASE("of thousands in one place two are named") {
  std::vector<BodySetup> setups(2000, body_of_mesh(generate_mesh("icosphere:1")));
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  CHECK(find_overlap(start.model, start.state.world_positions(start.model), {}, 64)->distance == 0);
}

TEST_CASE("bodies of which one is longer have a way out, too") {
  const ModelAndState start = cubes({{1, {0.9, 0.9, 0.03}}});
  std::vector<glm::dvec3> positions = start.state.world_positions(start.model);
  for (std::uint32_t i = start.model.bodies[1].first_vertex; i < positions.size(); ++i)
    positions[i].z *= 2;  // longer than the other
  const Overlap overlap = find_overlap(start.model, positions, {}, 64).value();
  CHECK(not_apart(start.model, positions) > 0);
  CHECK(not_apart(start.model, moved(start.model, positions, overlap)) == 0);
}

TEST_CASE("pairs of triangles that touch are counted, and those a nanometre apart are not") {
  const ModelAndState start = cubes({{0.5, {0.7, 0.02, 0}}, {0.5, {0, 0.80, 0.01}}});
  std::vector<glm::dvec3> positions = start.state.world_positions(start.model);
  CHECK(count_touching_pairs(start.model, positions) == not_apart(start.model, positions));
  CHECK(not_apart(start.model, positions) > 10);
  for (const double far_away : {0.0, 1e4}) {
    CAPTURE(far_away);
    const ModelAndState near = cubes({{1, {1 + 1e-9, 0.02, 0.03}}});
    positions = near.state.world_positions(near.model);
    for (glm::dvec3& place : positions) place.z += far_away;
    REQUIRE(not_apart(near.model, positions) == 0);
    CHECK(count_touching_pairs(near.model, positions) == 0);
  }
}

}  // namespace
}  // namespace pliant
