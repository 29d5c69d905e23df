// The rigid motion of a body, whole or deformed.
#include "model/body_motion.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "mesh/generators.hpp"

namespace pliant {
namespace {

ModelAndState turned(const char* mesh, const glm::dvec3& stretch) {
  BodySetup setup{generate_mesh(mesh), {}};
  BodyDescription& body = setup.description;
  body.position = {100, -2, 3};
  body.rotation = {20, -70, 130};
  body.velocity = {1, 2, -3};
  body.spin = {0.5, -4, 2};
  body.stretch = stretch;
  return build_model(std::array{setup}, {});
}

double angle_between(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = a * glm::conjugate(b);
  return 2 * glm::length(glm::dvec3(turn.x, turn.y, turn.z));
}

TEST_CASE("a body has the motion that its description gives it, also if it is stretched") {
  for (const char* mesh : {"icosphere:2", "box:2,0.2,0.3,8", "cube:1"})
    for (const glm::dvec3& stretch : {glm::dvec3(1), glm::dvec3(0.6, 1, 1.7), glm::dvec3(3)}) {
      CAPTURE(mesh, stretch.x, stretch.y);
      const ModelAndState bodies = turned(mesh, stretch);
      const BodyMotion motion = body_motion(bodies.model, bodies.state, 0);
      CHECK(glm::distance(motion.centre, glm::dvec3(100, -2, 3)) < 1e-5);  // rest positions are rounded to fp32
      CHECK(angle_between(motion.rotation, rotation_of({20, -70, 130})) < 1e-6);
      CHECK(glm::distance(motion.velocity, glm::dvec3(1, 2, -3)) < 1e-6);
      CHECK(glm::distance(motion.spin, glm::dvec3(0.5, -4, 2)) < 1e-12);
    }
}

TEST_CASE("a rotation is found however far the body has turned, and vertices on a line turn no more than the line") {
  for (const glm::dvec3& angles : {glm::dvec3(0), glm::dvec3(-30, 100, 40), glm::dvec3(180, 0, 0), glm::dvec3(90, 90, 90)}) {
    CAPTURE(angles.x, angles.y, angles.z);
    ModelAndState bodies = turned("icosphere:1", {0.6, 1, 1.7});
    const glm::dquat turn = rotation_of(angles);
    for (std::uint32_t i = 0; i < bodies.model.vertex_count(); ++i) {
      const glm::dvec3 rest = bodies.model.rest_position(i), u = turn * (rest + bodies.state.displacement(i)) - rest;
      STORE3(bodies.state.motion, physics::displacement_of(i), u)
    }
    CHECK(angle_between(body_motion(bodies.model, bodies.state, 0).rotation, rotation_of({20, -70, 130}) * turn) < 1e-6);
  }
  BodySetup line{{{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {}}, {}};
  ModelAndState bodies = build_model(std::array{line}, {});
  const glm::dquat turn = rotation_of({0, 0, 30});
  for (std::uint32_t i = 0; i < 3; ++i) {
    const glm::dvec3 rest = bodies.model.rest_position(i), u = turn * rest - rest;
    STORE3(bodies.state.motion, physics::displacement_of(i), u)
  }
  CHECK(angle_between(body_motion(bodies.model, bodies.state, 0).rotation, turn) < 1e-6);
}

TEST_CASE("a turn that a body has in its frame counts as its rotation, and shear leaves what is nearest") {
  ModelAndState bodies = turned("box:2,1,0.5,6", glm::dvec3(1));
  const glm::dquat turn = rotation_of({30, 10, -50});
  const glm::dmat3 stretch(glm::dvec3(1.3, 0.2, 0), glm::dvec3(0.2, 0.8, -0.1), glm::dvec3(0, -0.1, 1.1));  // symmetric
  for (std::size_t i = 0; i < bodies.model.vertex_count(); ++i) {
    const glm::dvec3 rest = bodies.model.rest_position(i), u = turn * (stretch * rest) - rest;
    for (int k = 0; k < 3; ++k) bodies.state.motion[physics::displacement_of(static_cast<std::uint32_t>(i)) + k] = u[k];
  }
  const glm::dquat found = body_motion(bodies.model, bodies.state, 0).rotation;
  CHECK(angle_between(found, rotation_of({20, -70, 130}) * turn) < 0.2);
  const auto squares = [&](const glm::dquat& rotation) {
    double sum = 0;
    for (std::size_t i = 0; i < bodies.model.vertex_count(); ++i) {
      const glm::dvec3 rest = bodies.model.rest_position(i);
      const glm::dvec3 left = turn * (stretch * rest) - glm::conjugate(rotation_of({20, -70, 130})) * rotation * rest;
      sum += glm::dot(left, left);
    }
    return sum;
  };
  for (const glm::dvec3& other : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
    for (const double degrees : {-0.1, 0.1}) CHECK(squares(found) < squares(rotation_of(degrees * other) * found));
}

}  // namespace
}  // namespace pliant
