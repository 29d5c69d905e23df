// Boxes, velocities and contacts as lines.
#include "view/marks.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "support/collision_scene.hpp"

using namespace pliant;
using namespace pliant::view;

namespace {

struct Scene {
  Scene() {
    for (const glm::dvec3& p : positions) rounded.emplace_back(glm::vec3(p), 1.0f);
    forest = build_forest(start.model, rounded, {});
  }
  ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  std::vector<glm::dvec3> positions = start.state.world_positions(start.model);
  std::vector<glm::vec4> rounded;
  Forest forest;
};

TEST_CASE("at the root's level there is a box a body, around all of it") {
  const Scene scene;
  Lines lines;
  add_boxes(lines, scene.forest, scene.positions, 0);
  REQUIRE(lines.size() == 2 * 2 * 12);
  for (std::size_t b = 0; b < 2; ++b) {
    const ModelBody& body = scene.start.model.bodies[b];
    const auto box = render::box_around(std::span(scene.positions).subspan(body.first_vertex, body.vertex_count));
    for (std::size_t end = 24 * b; end < 24 * (b + 1); ++end)
      for (int k = 0; k < 3; ++k)
        CHECK((lines[end].place[k] == Approx(box.low[k]) || lines[end].place[k] == Approx(box.high[k])));
  }
}

TEST_CASE("boxes at deeper levels are more and smaller, down to the leaves") {
  const Scene scene;
  std::size_t before = 0;
  for (unsigned level = 0; level <= scene.forest.depth; ++level) {
    Lines lines;
    add_boxes(lines, scene.forest, scene.positions, level);
    CHECK(lines.size() >= before);
    before = lines.size();
  }
  CHECK(before == 24 * scene.forest.leaves.size());
}

TEST_CASE("velocities are lines from the vertices, and contacts crosses at the touching ones") {
  const Scene scene;
  Lines lines;
  add_velocities(lines, scene.positions, scene.start.state.world_velocities(scene.start.model));
  CHECK(lines.size() == 2 * scene.positions.size());
  CHECK(lines[1].place.x - lines[0].place.x > 0);  // the left body moves to the right
  lines.clear();
  add_contacts(lines, scene.start.model, scene.positions, std::vector<std::uint32_t>{3});
  REQUIRE(lines.size() == 6);
  for (std::size_t k = 0; k < 6; k += 2)
    CHECK(glm::distance(glm::dvec3(lines[k].place + lines[k + 1].place) * 0.5, scene.positions[3]) < 1e-6);
}

}  // namespace
