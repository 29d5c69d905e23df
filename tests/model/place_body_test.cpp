// Vertices that a program puts elsewhere.
#include "model/place_body.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "mesh/generators.hpp"
#include "model/body_motion.hpp"

namespace pliant {
namespace {

constexpr glm::dvec3 gravity{0, -9.81, 1};

ModelAndState two_turned_bodies() {
  std::array<BodySetup, 2> setups;
  for (BodySetup& setup : setups) {
    setup.mesh = generate_mesh("icosphere:1");
    setup.description.rotation = {20, -70, 130};
    setup.description.velocity = {1, 2, -3};
    setup.description.spin = {0.5, -4, 2};
    setup.description.stretch = {0.6, 1, 1.7};
  }
  setups[1].description.position = {5, 0, 0};
  return build_model(setups, gravity);
}

double farthest(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  double farthest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) farthest = std::max(farthest, glm::distance(a[i], b[i]));
  return farthest;
}

TEST_CASE("a body that is placed stands there, keeps its velocities, and leaves other bodies alone") {
  const ModelAndState bodies = two_turned_bodies();
  const ModelBody& body = bodies.model.bodies[1];
  const auto before = bodies.state.world_positions(bodies.model), velocities = bodies.state.world_velocities(bodies.model);
  const glm::dquat turn = rotation_of({-30, 100, 40});
  std::vector<glm::dvec3> placed = before;
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i)
    placed[i] = turn * before[i] + glm::dvec3(100, -20, 3);
  State state = bodies.state;
  place_body(state, bodies.model, 1, std::span(placed).subspan(body.first_vertex, body.vertex_count), gravity);
  CHECK(farthest(state.world_positions(bodies.model), placed) < 1e-13 * 100);
  CHECK(farthest(state.world_velocities(bodies.model), velocities) < 1e-13);
  CHECK(std::equal(state.motion.begin(), state.motion.begin() + physics::motion_size * body.first_vertex,
                   bodies.state.motion.begin()));

  SECTION("its frame goes along, so that displacements stay as small as they were") {
    double largest = 0, largest_before = 0;
    for (std::size_t i = body.first_vertex; i < bodies.model.vertex_count(); ++i) {
      largest = std::max(largest, glm::length(state.displacement(i)));
      largest_before = std::max(largest_before, glm::length(bodies.state.displacement(i)));
    }
    CHECK(largest < 1.01 * largest_before);
  }
  SECTION("the frame's gravity is the world's") {
    const physics::Pose& pose = state.poses[1];
    CHECK(glm::distance(physics::rotate(pose, {pose.gravity[0], pose.gravity[1], pose.gravity[2]}), gravity) < 1e-13);
  }
}

TEST_CASE("velocities that are set are those in the world, and places stay to the bit") {
  const ModelAndState bodies = two_turned_bodies();
  std::vector<glm::dvec3> wanted;
  for (std::uint32_t k = 0; k < bodies.model.bodies[0].vertex_count; ++k) wanted.push_back({k, 1, -2.5 * k});
  State state = bodies.state;
  set_velocities(state, bodies.model, 0, wanted);
  const auto velocities = state.world_velocities(bodies.model);
  CHECK(farthest(wanted, std::span(velocities).first(wanted.size())) < 1e-13 * 100);
  CHECK(state.world_positions(bodies.model) == bodies.state.world_positions(bodies.model));
}

}  // namespace
}  // namespace pliant
