#include "model/model.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "mesh/generators.hpp"
#include "support/expect_error.hpp"

namespace pliant {
namespace {

/// A lopsided tetrahedron, so that no symmetry hides a mistake.
BodySetup lopsided() {
  BodySetup setup;
  setup.mesh = {{{0.3, -0.1, 0.2}, {2.1, 0.4, -0.3}, {0.5, 1.7, 0.1}, {-0.4, 0.2, 3.3}},
                {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  setup.description.name = "lopsided";
  setup.description.scale = 0.5;
  setup.description.position = {10, -20, 30};
  setup.description.rotation = {30, -50, 110};
  return setup;
}

glm::dvec3 turn(const glm::dvec3& degrees, glm::dvec3 p) {
  const glm::dvec3 c = glm::cos(glm::radians(degrees)), s = glm::sin(glm::radians(degrees));
  p = {p.x, c.x * p.y - s.x * p.z, s.x * p.y + c.x * p.z};
  p = {c.y * p.x + s.y * p.z, p.y, -s.y * p.x + c.y * p.z};
  return {c.z * p.x - s.z * p.y, s.z * p.x + c.z * p.y, p.z};
}

glm::dvec3 mean(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

ModelAndState build(const BodySetup& setup, const glm::dvec3& gravity = {0, 0, 0}) { return build_model({&setup, 1}, gravity); }

void check_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) { CHECK(glm::distance(a, b) < tolerance); }

}  // namespace

TEST_CASE("a vertex is scaled, turned about x, then y, then z through the mesh's origin, and moved") {
  const BodySetup setup = lopsided();
  const ModelAndState built = build(setup);
  const std::vector<glm::dvec3> world = built.state.world_positions(built.model);
  for (std::size_t i = 0; i < world.size(); ++i)
    check_near(world[i], setup.description.position + turn(setup.description.rotation, 0.5 * setup.mesh.positions[i]), 1e-6);
}

TEST_CASE("rest positions are centred, carry their body's index, and are the radius away at most") {
  const BodySetup setups[] = {lopsided(), lopsided()};
  const Model model = build_model(setups, {0, 0, 0}).model;
  glm::dvec3 sum(0.0);
  double farthest = 0;
  for (std::uint32_t i = 0; i < model.vertex_count(); ++i) {
    CHECK(model.rest_positions[i].w == static_cast<float>(i / 4));
    sum += glm::dvec3(model.rest_positions[i]);
    farthest = std::max(farthest, glm::length(glm::dvec3(model.rest_positions[i])));
  }
  CHECK(glm::length(sum) < 1e-6);
  CHECK(model.bodies[0].radius == farthest);
}

TEST_CASE("bodies are consecutive ranges, and triangles name vertices of all bodies together") {
  const BodySetup setups[] = {lopsided(), lopsided()};
  const Model model = build_model(setups, {0, 0, 0}).model;
  const ModelBody& second = model.bodies[1];
  CHECK((second.first_vertex == 4 && second.vertex_count == 4 && second.first_triangle == 4 && second.triangle_count == 4));
  CHECK(model.triangles[4] == std::array<std::uint32_t, 3>{4, 6, 5});
}

TEST_CASE("a stretch leaves the centroid and multiplies distances along the body's axes") {
  BodySetup setup = lopsided();
  const ModelAndState plain = build(setup);
  setup.description.stretch = {1.5, 0.8, 1.2};
  const ModelAndState stretched = build(setup);
  const std::vector<glm::dvec3> before = plain.state.world_positions(plain.model);
  const std::vector<glm::dvec3> after = stretched.state.world_positions(stretched.model);
  check_near(mean(after), mean(before), 1e-6);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 rest(plain.model.rest_positions[i]);
    check_near(after[i] - before[i], turn(setup.description.rotation, (setup.description.stretch - 1.0) * rest), 1e-13);
  }
}

TEST_CASE("without a stretch nothing is displaced, so no spring is strained") {
  const State state = build(lopsided()).state;
  for (std::size_t vertex = 0; vertex < 4; ++vertex)
    for (std::size_t k = 0; k < 3; ++k) CHECK(state.motion[6 * vertex + k] == 0);
}

TEST_CASE("spin turns the body about its centroid and adds no momentum") {
  BodySetup setup = lopsided();
  setup.description.velocity = {3, -4, 5};
  setup.description.spin = {0.5, -2, 7};
  setup.description.stretch = {1.5, 0.8, 1.2};
  const ModelAndState built = build(setup);
  const std::vector<glm::dvec3> positions = built.state.world_positions(built.model);
  const std::vector<glm::dvec3> velocities = built.state.world_velocities(built.model);
  check_near(mean(velocities), setup.description.velocity, 1e-13);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)  // rigid motion: relative velocity is spin x distance
      check_near(velocities[i] - velocities[j], glm::cross(setup.description.spin, positions[i] - positions[j]), 1e-12);
}

TEST_CASE("a frame's rotation is orthonormal, matches its quaternion and turns the world's gravity") {
  const glm::dvec3 gravity(1, -9.81, 2);
  const State state = build(lopsided(), gravity).state;
  const physics::Pose& frame = state.poses[0];
  const glm::dvec3 x(frame.rotation[0], frame.rotation[1], frame.rotation[2]),
      y(frame.rotation[3], frame.rotation[4], frame.rotation[5]), z(frame.rotation[6], frame.rotation[7], frame.rotation[8]);
  check_near(glm::cross(x, y), z, 1e-14);
  CHECK(glm::dot(x, y) == Approx(0).margin(1e-14));
  CHECK(glm::length(x) == Approx(1).epsilon(1e-14));
  const glm::dvec3 axis(frame.quaternion[0], frame.quaternion[1], frame.quaternion[2]), p(0.3, -1.2, 0.7);
  const glm::dvec3 twice = 2.0 * glm::cross(axis, p);
  check_near(physics::rotate(frame, p), p + frame.quaternion[3] * twice + glm::cross(axis, twice), 1e-14);
  check_near(physics::rotate(frame, {frame.gravity[0], frame.gravity[1], frame.gravity[2]}), gravity, 1e-14);
}

TEST_CASE("an unrotated body's frame is exactly the world's") {
  BodySetup setup = lopsided();
  setup.description.rotation = {0, 0, 0};
  const physics::Pose frame = build(setup).state.poses[0];
  for (int i = 0; i < 9; ++i) CHECK(frame.rotation[i] == (i % 4 == 0 ? 1.0 : 0.0));
}

TEST_CASE("material that is given in total does not depend on the mesh's density") {
  for (const char* mesh : {"icosphere:1", "icosphere:2"}) {
    BodySetup setup;
    setup.mesh = generate_mesh(mesh);
    setup.description.total_stiffness = 1000;
    setup.description.total_mass = 5;
    const Model model = build(setup).model;
    const double n = model.vertex_count();
    CHECK(model.bodies[0].vertex_mass * n == Approx(5));
    CHECK(model.bodies[0].stiffness * n * n == Approx(1000));
  }
}

TEST_CASE("a mesh without vertices, and numbers beyond reach, are input errors that name the body") {
  BodySetup empty;
  empty.description.name = "nothing";
  empty.description.where = "scene.toml:7";
  const Error error = error_of([&] { return build(empty); });
  CHECK(error.kind() == ErrorKind::input);
  check_says(error, {"scene.toml:7: body.nothing", "no vertices"});

  const auto broken = [](auto change) {
    BodySetup setup = lopsided();
    change(setup);
    return error_of([&] { return build(setup); });
  };
  check_says(broken([](BodySetup& s) { s.description.scale = 1e12; }), {"body.lopsided", "beyond"});
  check_says(broken([](BodySetup& s) { s.mesh.positions[2].y = std::numeric_limits<double>::quiet_NaN(); }), {"body.lopsided"});
  check_says(broken([](BodySetup& s) { s.description.spin = {0, 1e9, 0}; }), {"body.lopsided", "faster"});
}

TEST_CASE("more bodies than pairs can be counted of are an input error that names the first one too many") {
  BodySetup point;
  point.mesh.positions = {{0, 0, 0}};
  std::vector<BodySetup> setups(65536, point);
  setups.back().description.name = "last";
  const Error error = error_of([&] { return build_model(setups, {0, 0, 0}); });
  CHECK(error.kind() == ErrorKind::input);
  check_says(error, {"body.last", "65536 bodies", "65535"});
  setups.pop_back();
  CHECK_NOTHROW(build_model(setups, {0, 0, 0}));
}

TEST_CASE("a point cloud without triangles is a body") {
  BodySetup setup;
  setup.mesh.positions = {{-1, 0, 0}, {1, 0, 0}};
  const ModelAndState built = build(setup);
  CHECK(built.model.bodies[0].triangle_count == 0);
  CHECK(built.model.bodies[0].radius == 1);
}

TEST_CASE("a body too small for forces in fp32 is an input error, even if all its vertices are one point") {
  BodySetup small = lopsided(), point = lopsided();
  small.description.scale = 1e-7;
  std::ranges::fill(point.mesh.positions, glm::dvec3(1, 2, 3));
  for (const BodySetup& setup : {small, point}) {
    const Error error = error_of([&] { return build(setup); });
    CHECK(error.kind() == ErrorKind::input);
    check_says(error, {"lopsided", "1e-06 m", "scale"});
  }
}

TEST_CASE("a ground's normal gives its direction at any length whatever") {
  const BodySetup setup = lopsided();
  for (const double length : {5e-324, 1e-300, 1e-170, 1.0, 1e9}) {
    CAPTURE(length);
    GroundDescription ground;
    ground.point = {0, 2, 0};
    ground.normal = {0, -length, length};
    const Model model = build_model({&setup, 1}, {0, 0, 0}, {&ground, 1}).model;
    CHECK(glm::length(model.grounds[0].normal) == Approx(1));
    CHECK(model.grounds[0].normal.y == -model.grounds[0].normal.z);
    CHECK(model.grounds[0].offset == Approx(-std::sqrt(2)));
  }
}

}  // namespace pliant
