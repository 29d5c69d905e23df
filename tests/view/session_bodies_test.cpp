// Bodies that come, go, are shaken and are led while a scene plays.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>

#include "mesh/generators.hpp"
#include "support/scratch.hpp"
#include "view/session.hpp"

using namespace pliant;
using namespace pliant::view;

namespace {

// A ball in a box, with gravity.
LoadedScene boxed() {
  const test::ScratchFolder folder;
  const auto file = folder.path / "boxed.toml";
  std::ofstream(file)
      << "[simulation]\nintegrator = \"verlet\"\ntime_step = 0.005\ngravity = [0, -9.81, 0]\n"
         "[[body]]\nname = \"ball\"\nmesh = \"icosphere:1\"\nscale = 0.4\nposition = [0, 0.5, 0]\ntotal_mass = 1\n"
         "total_stiffness = 2000\n"
         "[[body]]\nname = \"other\"\nmesh = \"icosphere:1\"\nscale = 0.3\nposition = [0.6, 0.5, 0.5]\ntotal_mass = 1\n"
         "total_stiffness = 2000\n"
         "[[container]]\nsize = [2, 2, 2]\nposition = [0, 1, 0]\nopen = true\n";
  return load(file);
}

BodySetup small_ball(const glm::dvec3& position) {
  BodySetup setup{generate_mesh("icosphere:1"), {}};
  setup.description.name = "more";
  setup.description.mesh = "icosphere:1";
  setup.description.scale = 0.2;
  setup.description.position = position;
  setup.description.total_mass = 0.3;
  setup.description.total_stiffness = 500;
  return setup;
}

std::vector<glm::dvec3> positions_of_body(Session& session, std::uint32_t b) {
  const ModelBody& body = session.model().bodies[b];
  std::vector<glm::dvec3> positions;
  for (std::uint32_t i = 0; i < body.vertex_count; ++i)
    positions.push_back(session.simulation().state().world_position(session.model(), body.first_vertex + i));
  return positions;
}

TEST_CASE("a body that is added or removed leaves the others where they are, and is undone by a restart") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, boxed());
  session.advance_toward(0.2, 1000);
  const auto ball = positions_of_body(session, 0), other = positions_of_body(session, 1), box = positions_of_body(session, 2);
  const double time = session.time();
  session.add(small_ball({-0.5, 1.5, -0.5}));
  REQUIRE(session.model().bodies.size() == 4);
  CHECK((session.model().bodies[2].name == "more" && session.model().bodies[3].is_container));
  CHECK(session.time() == time);
  CHECK(
      (positions_of_body(session, 0) == ball && positions_of_body(session, 1) == other && positions_of_body(session, 3) == box));
  session.remove(0);
  REQUIRE(session.model().bodies.size() == 3);
  CHECK((positions_of_body(session, 0) == other && positions_of_body(session, 2) == box));
  session.advance_toward(1, 1000);
  CHECK(session.simulation().intersections().pairs == 0);
  session.remove(1);
  CHECK_THROWS_WITH(session.remove(0), Catch::Contains("the last soft body"));
  CHECK(session.model().bodies.size() == 2);
  session.restart();
  CHECK((session.model().bodies.size() == 3 && session.step() == 0));
  session.advance_toward(0.2, 1000);
  CHECK(positions_of_body(session, 0) == ball);
}

TEST_CASE(
    "bodies may be added and settings changed where bodies are too near each other for proofs, but not where they intersect") {
  const auto device = make_cpu_device(2, 32);
  const test::ScratchFolder folder;
  const auto file = folder.path / "ball.toml";
  std::ofstream(file) << "[[body]]\nmesh = \"icosphere:1\"\n";
  Session session(*device, load(file));
  const double touching = 1.2;  // from centre to centre, as each has a vertex on the axis
  CHECK_NOTHROW(session.add(small_ball({touching + 1e-7, 0, 0})));
  Settings settings = session.settings();
  settings.friction = 0.25;
  CHECK_NOTHROW(session.change(settings));
  CHECK_THROWS_WITH(session.add(small_ball({-touching + 0.01, 0, 0})), Catch::Contains("intersect"));
  CHECK(session.model().bodies.size() == 2);
}

TEST_CASE("a body that would touch another is not added") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, boxed());
  session.advance_toward(0.1, 1000);
  const auto before = session.simulation().state().motion;
  CHECK_THROWS_WITH(session.add(small_ball({0.3, 0.5, 0})), Catch::Contains("intersect"));
  CHECK(session.model().bodies.size() == 3);
  CHECK(session.simulation().state().motion == before);
}

TEST_CASE("a scripted body stays on its path when settings change") {
  const test::ScratchFolder folder;
  const auto file = folder.path / "moving.toml";
  std::ofstream(file)
      << "[simulation]\ntime_step = 0.01\n[[body]]\nmesh = \"icosphere:1\"\n"
         "[[body]]\nkind = \"scripted\"\nmesh = \"cube:1\"\n"
         "path = [{ time = 0, position = [3, 0, 0] }, { time = 2, position = [3, 4, 0], rotation = [0, 0, 90] }]\n";
  const auto device = make_cpu_device(1, 32);
  Session session(*device, load(file));
  session.advance_toward(1, 1000);
  const std::vector<glm::dvec3> before = positions_of_body(session, 1);
  Settings settings = session.settings();
  settings.elasticity = 0.3;
  session.change(settings);
  CHECK(positions_of_body(session, 1) == before);
  session.step_once();
  const std::vector<glm::dvec3> after = positions_of_body(session, 1);
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(glm::distance(after[i], before[i]) < 0.06);
  CHECK(session.report().response.scripts.at(0).time == Approx(1.01));
}

TEST_CASE("a shaken container keeps what it holds, ends where it began, and can be shaken again") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, boxed());
  session.advance_toward(0.3, 1000);
  const auto box = positions_of_body(session, 2);
  for (const double end : {2.0, 4.0}) {
    session.shake();
    CHECK(session.model().bodies[2].kind == BodyKind::scripted);
    double farthest = 0;
    while (session.time() < end) {
      session.advance_toward(session.time() + 0.05, 1000);
      farthest = std::max(farthest, glm::distance(positions_of_body(session, 2).front(), box.front()));
      CHECK(session.simulation().intersections().pairs == 0);
    }
    CHECK(farthest > 0.1);
    CHECK(glm::distance(positions_of_body(session, 2).front(), box.front()) < 1e-9);
    for (const std::uint32_t b : {0u, 1u})
      for (const glm::dvec3& p : positions_of_body(session, b)) CHECK(std::max({std::abs(p.x), p.y - 1, std::abs(p.z)}) < 1);
  }
}

TEST_CASE("a hand goes where it is sent, pushes what it meets, and is taken away") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, boxed());
  session.advance_toward(0.5, 1000);
  const auto centre = [&](std::uint32_t b) {
    glm::dvec3 sum(0.0);
    const auto positions = positions_of_body(session, b);
    for (const glm::dvec3& p : positions) sum += p / double(positions.size());
    return sum;
  };
  session.put_hand({-0.7, 0.4, 0}, 0.1);
  REQUIRE(session.hand().has_value());
  CHECK(session.hand()->body == 2);
  const double before = centre(0).x;
  for (int k = 0; k < 30; ++k) {
    session.send_hand({0.2, 0.4, 0}, 0.1);
    session.advance_toward(session.time() + 1.0 / 60, 1000);
    CHECK(session.simulation().intersections().pairs == 0);
  }
  CHECK(glm::distance(centre(2), {0.2, 0.4, 0}) < 0.02);
  CHECK(centre(0).x > before + 0.1);
  session.take_hand();
  CHECK((!session.hand() && session.model().bodies.size() == 3));
  session.put_hand({-0.7, 0.4, 0}, 0.1);
  session.restart();
  CHECK((!session.hand() && session.model().bodies.size() == 3));
}

// Returns how far the body's vertices go at most while `act` acts.
double shift_of(Session& session, const std::function<std::uint32_t()>& body, const std::function<void()>& act) {
  const auto before = positions_of_body(session, body());
  act();
  const auto after = positions_of_body(session, body());
  double farthest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) farthest = std::max(farthest, glm::distance(before[i], after[i]));
  return farthest;
}

TEST_CASE("a hand stays on its way whatever else changes, and never jumps") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, boxed());
  session.put_hand({-0.7, 1.6, -0.7}, 0.1);
  const auto hand = [&] { return session.hand()->body; };
  const glm::dvec3 corners[] = {{0.7, 1.6, -0.7}, {-0.7, 1.6, -0.7}};
  const auto lead = [&](int corner) {
    for (int k = 0; k < 10; ++k) {
      session.send_hand(corners[corner % 2], 0.5);
      session.step_once();
    }
  };
  const std::function<void()> changes[] = {[&] {
                                             Settings settings = session.settings();
                                             settings.friction = 0.4;
                                             session.change(settings);
                                           },
                                           [&] {
                                             session.add(small_ball({0.7, 1.6, 0.7}));
                                           },
                                           [&] { session.shake(); },
                                           [&] { session.remove(0); },
                                           [&] { session.shake(); },  // while it is being shaken
                                           [&] { REQUIRE(session.step_back()); }};
  int corner = 0;
  for (const auto& change : changes) {
    CAPTURE(corner);
    lead(corner++);
    session.record();
    session.step_once();
    const double in_a_step = 0.05;  // [m], at a speed of some 5 m/s at most
    CHECK(shift_of(session, hand, change) < (corner == 6 ? in_a_step : 1e-12));
    CHECK(shift_of(session, hand, [&] { session.step_once(); }) < in_a_step);
    CHECK(shift_of(session, hand, [&] { lead(corner); }) < 10 * in_a_step);
    CHECK(session.simulation().intersections().pairs == 0);
  }
}

TEST_CASE("a shake that is asked for again in between goes on, and containers that the scene moves are not shaken") {
  const test::ScratchFolder folder;
  const auto file = folder.path / "boxes.toml";
  std::ofstream(file) << "[simulation]\ntime_step = 0.005\n[[body]]\nmesh = \"icosphere:1\"\nscale = 0.3\n"
                         "[[container]]\nsize = [2, 2, 2]\n"
                         "[[container]]\nsize = [2, 2, 2]\nposition = [5, 0, 0]\nspin = [0, 1, 0]\n";
  const auto device = make_cpu_device(1, 32);
  Session session(*device, load(file));
  for (int k = 0; k < 60; ++k) {
    if (k % 7 == 0) session.shake();
    for (const std::uint32_t container : {1u, 2u})
      CHECK(shift_of(
                session, [&] { return container; }, [&] { session.step_once(); }) < 0.025);  // 5 m/s
  }
  CHECK(shift_of(
            session, [] { return 2u; }, [&] { session.step_once(); }) > 0.004);  // at sqrt(2) m from its axis
}

TEST_CASE("a restart takes back bodies that came and went, and keeps settings") {
  const auto device = make_cpu_device(1, 32);
  Session session(*device, boxed());
  const double radius = session.radius(), damping = session.settings().materials[0].damping;
  session.add(small_ball({-0.5, 1.5, -0.5}));
  session.remove(0);
  CHECK(session.radius() == radius);
  Settings settings = session.settings();
  settings.friction = 0.4;
  settings.materials[0].damping = 0.125;  // of the body that was the second one
  session.change(settings);
  session.restart();
  REQUIRE(session.model().bodies.size() == 3);
  CHECK(session.settings().friction == 0.4);
  CHECK((session.model().bodies[0].damping == damping && session.model().bodies[1].damping == 0.125));
}

}  // namespace
