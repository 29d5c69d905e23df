// Boxes and velocities as lines.
#include "view/marks.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <limits>

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

/// The box whose edges are 12 lines, beginning at an end.
render::SceneBox box_at(const Lines& lines, std::size_t first_end) {
  std::vector<glm::dvec3> ends;
  for (std::size_t end = first_end; end < first_end + 24; ++end) ends.emplace_back(glm::vec3(lines[end].place));
  return render::box_around(ends);
}

TEST_CASE("boxes at deeper levels are more, and each is smaller than that above it, down to the leaves") {
  const Scene scene;
  std::size_t before = 0;
  double radius_before = std::numeric_limits<double>::infinity();
  for (unsigned level = 0; level <= scene.forest.depth; ++level) {
    Lines lines;
    add_boxes(lines, scene.forest, scene.positions, level);
    CHECK(lines.size() > before);
    before = lines.size();
    double radii = 0;
    for (std::size_t end = 0; end < lines.size(); end += 24) radii += box_at(lines, end).radius();
    const double radius = radii * 24 / static_cast<double>(lines.size());
    CHECK(radius < radius_before);
    radius_before = radius;
  }
  CHECK(before == 24 * static_cast<std::size_t>(std::ranges::count_if(scene.forest.nodes, &TreeNode::is_leaf)));
}

TEST_CASE("velocities are lines from the vertices, as long as a tenth of a second's way") {
  const Scene scene;
  const auto velocities = scene.start.state.world_velocities(scene.start.model);
  Lines lines;
  add_velocities(lines, scene.positions, velocities);
  REQUIRE(lines.size() == 2 * scene.positions.size());
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    CHECK(glm::distance(glm::dvec3(lines[2 * i].place), scene.positions[i]) < 1e-6);
    CHECK(glm::distance(glm::dvec3(lines[2 * i + 1].place - lines[2 * i].place), 0.1 * velocities[i]) < 1e-6);
  }
}

}  // namespace
