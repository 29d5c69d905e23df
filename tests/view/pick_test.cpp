// Rays through pixels, and what they hit.
#include "view/pick.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "support/evolve.hpp"

using namespace pliant;
using namespace pliant::view;

namespace {

const glm::dvec2 picture_size(640, 480);
const CameraDescription viewpoint{{3, 2, 5}, {0.2, 0.1, 0}, 40};

glm::dvec2 pixel_of(const glm::dvec3& place) {
  const glm::dvec4 clip = render::view_projection(viewpoint, picture_size.x / picture_size.y) * glm::dvec4(place, 1);
  return {(clip.x / clip.w + 1) / 2 * picture_size.x, (1 - clip.y / clip.w) / 2 * picture_size.y};
}

std::vector<glm::vec4> positions_of(const ModelAndState& start) {
  std::vector<glm::vec4> positions;
  for (const glm::dvec3& position : start.state.world_positions(start.model)) positions.emplace_back(glm::vec3(position), 1.0f);
  return positions;
}

TEST_CASE("a ray through a place's pixel goes through the place") {
  for (const glm::dvec3 place : {glm::dvec3(1, 0, 0), {-2, 1, 1}, {0, -1, -7}}) {
    const Ray ray = ray_through(viewpoint, pixel_of(place), picture_size);
    CHECK(glm::length(glm::cross(glm::normalize(ray.direction), place - ray.origin)) < 1e-9);
    CHECK(glm::dot(ray.direction, place - ray.origin) > 0);
  }
}

TEST_CASE("each vertex that can be seen is picked at its pixel, and none behind the body") {
  const ModelAndState start = built(sphere(2));
  const auto positions = positions_of(start);
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const glm::dvec3 place(glm::vec3(positions[i]));
    const auto picked = pick_vertex(start.model, positions, ray_through(viewpoint, pixel_of(place * 0.999), picture_size));
    REQUIRE(picked);
    const double facing = glm::dot(place, glm::normalize(viewpoint.eye - place));
    if (facing > 0.2) CHECK(*picked == i);
    if (facing < -0.2) CHECK(*picked != i);
  }
  CHECK_FALSE(pick_vertex(start.model, positions, ray_through(viewpoint, {1, 1}, picture_size)));
}

TEST_CASE("of two bodies in line the nearer one is picked") {
  std::vector<BodySetup> setups{sphere(1), sphere(1)};
  setups[0].description.position = {0, 0, -5};
  const ModelAndState start = build_model(setups, {0, 0, 0});
  const Ray ray{{0.1, 0.1, 9}, {0, 0, -1}};
  CHECK(start.model.body_index(*pick_vertex(start.model, positions_of(start), ray)) == 1);
}

TEST_CASE("a ray meets a plane before it, and never one behind it or alongside") {
  const glm::dvec3 point(1, 2, 3), normal(0, 0, 1);
  const Ray ray{{0, 0, 9}, {0.5, 0.25, -1}};
  const glm::dvec3 met = meet_plane(ray, point, normal);
  CHECK(met == glm::dvec3(3, 1.5, 3));
  CHECK(meet_plane({{0, 0, 9}, {0, 0, 1}}, point, normal) == point);
  CHECK(meet_plane({{0, 0, 9}, {1, 0, 0}}, point, normal) == point);
}

}  // namespace
