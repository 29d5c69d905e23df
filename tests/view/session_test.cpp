// Scenes that go on, back and back to the start, on every device and without a window.
#include "view/session.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>

#include "gl/context.hpp"
#include "mesh/generators.hpp"
#include "support/expect_error.hpp"
#include "support/has.hpp"
#include "support/paths.hpp"
#include "support/scratch.hpp"

using namespace pliant;
using namespace pliant::view;

namespace {

// Two small spheres that meet after some 20 steps.
LoadedScene colliding(const char* timing = "time_step = 0.002\n") {
  const test::ScratchFolder folder;
  const auto file = folder.path / "meeting.toml";
  std::ofstream(file) << "[simulation]\nintegrator = \"dop853\"\n"
                      << timing
                      << "[[body]]\nmesh = \"icosphere:1\"\nposition = [-1.1, 0.1, 0]\nvelocity = [4, 0, 0]\nspin = [0, 1, 0]\n"
                         "[[body]]\nmesh = \"icosphere:1\"\nposition = [1.1, 0, 0]\nstretch = [0.9, 1, 1]\n";
  return load(file);
}

constexpr const char* by_tolerance = "tolerance = 1e-5\n";

void on_every_device(const std::function<void(Device&)>& check) {
  check(*make_cpu_device(2, 64));
  check(*make_cpu_device(2, 32));
  if (test::has_gl()) check(*make_gpu_device(0));
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

std::vector<double> motion_of(Session& session) { return session.simulation().state().motion; }

TEST_CASE("a session makes the steps that are due at a time, and no others", "[gl]") {
  on_every_device([](Device& device) {
    Session session(device, colliding());
    CHECK_FALSE(session.is_due(0));
    CHECK_FALSE(session.is_due(0.0019));
    REQUIRE(session.is_due(0.0201));
    session.advance_toward(0.0201, 3);
    CHECK(session.step() == 3);
    session.advance_toward(0.0201, 100);
    CHECK(session.step() == 10);
    CHECK(session.time() == 10 * 0.002);
    CHECK_FALSE(session.is_due(0.0201));
    session.advance_toward(0.0201, 100);
    CHECK(session.step() == 10);
  });
}

TEST_CASE("steps that a tolerance governs end at frames, whatever goals a viewer has", "[gl]") {
  on_every_device([](Device& device) {
    Session coarse(device, colliding(by_tolerance)), fine(device, colliding(by_tolerance));
    while (coarse.is_due(0.1)) coarse.advance_toward(0.1, 32);
    for (double goal = 0; goal < 0.1; goal += 0.0031)
      while (fine.is_due(goal)) fine.advance_toward(goal, 1);
    while (fine.is_due(0.1)) fine.advance_toward(0.1, 1);
    CHECK(coarse.time() == Approx(0.1));
    CHECK(coarse.step() == fine.step());
    CHECK(coarse.time() == fine.time());
    CHECK(same_bits(motion_of(coarse), motion_of(fine)));
  });
}

TEST_CASE("going back restores the very bits, in contact too", "[gl]") {
  for (const char* timing : {"time_step = 0.002\n", by_tolerance}) {
    on_every_device([&](Device& device) {
      Session session(device, colliding(timing));
      std::vector<std::vector<double>> motions{motion_of(session)};
      std::vector<double> times{session.time()};
      for (int k = 0; k < 40; ++k) {
        session.step_once();
        session.record();
        motions.push_back(motion_of(session));
        times.push_back(session.time());
      }
      CHECK(session.simulation().report().contact_steps > 0);
      for (std::size_t step = 40; step-- > 0;) {
        REQUIRE(session.step_back());
        CHECK(session.step() == step);
        CHECK(session.time() == times[step]);
        CHECK(same_bits(motion_of(session), motions[step]));
      }
      CHECK_FALSE(session.step_back());
    });
  }
}

TEST_CASE("where pictures were further apart than steps, going back still goes by one step, to the very bits", "[gl]") {
  on_every_device([](Device& device) {
    Session direct(device, colliding()), session(device, colliding());
    std::vector<std::vector<double>> motions{motion_of(direct)};
    for (std::uint64_t step = 1; step <= 40; ++step) {
      direct.step_once();
      motions.push_back(motion_of(direct));
      if (step % 8 != 0) continue;
      session.advance_toward(0.002 * static_cast<double>(step), 100);
      session.record();
    }
    CHECK(direct.simulation().report().contact_steps > 0);
    for (std::uint64_t step = 40; step-- > 0;) {
      REQUIRE(session.step_back());
      CHECK(session.step() == step);
      CHECK(session.time() == 0.002 * static_cast<double>(step));
      CHECK(same_bits(motion_of(session), motions[step]));
    }
  });
}

TEST_CASE("a restarted scene plays as it did the first time, bit for bit", "[gl]") {
  on_every_device([](Device& device) {
    Session session(device, colliding());
    session.advance_toward(0.08, 100);
    const auto first = motion_of(session);
    session.restart();
    CHECK(session.step() == 0);
    CHECK_FALSE(session.step_back());
    session.advance_toward(0.08, 100);
    CHECK(same_bits(motion_of(session), first));
  });
}

TEST_CASE("a session that moves to another device keeps its state and its way back, to the bit", "[gl]") {
  if (test::lacks_gl()) return;
  for (const char* timing : {"time_step = 0.002\n", by_tolerance}) {
    const auto cpu = make_cpu_device(2, 32), gpu = make_gpu_device(0);
    Session session(*cpu, colliding(timing)), stays(*cpu, colliding(timing));
    std::vector<std::vector<double>> motions;
    for (int k = 0; k < 30; ++k) {
      motions.push_back(motion_of(session));
      session.step_once();
      session.record();
      stays.step_once();
    }
    const StepReport before = session.simulation().report();
    const auto motion = motion_of(session);
    session.move_to(*gpu);
    CHECK(session.simulation().report() == before);
    CHECK(same_bits(motion_of(session), motion));
    session.step_once();
    CHECK(session.step() == 31);
    REQUIRE(session.step_back());
    session.move_to(*cpu);
    CHECK(same_bits(motion_of(session), motion));
    session.step_once();
    stays.step_once();
    CHECK(same_bits(motion_of(session), motion_of(stays)));
    session.move_to(*gpu);
    for (std::size_t step = 31; step-- > 0;) {
      REQUIRE(session.step_back());
      if (step < 30) CHECK(same_bits(motion_of(session), motions[step]));
    }
    session.restart();
    CHECK(same_bits(motion_of(session), motions[0]));
  }
}

TEST_CASE("touching vertices are those that the latest step held back", "[gl]") {
  on_every_device([](Device& device) {
    LoadedScene reflecting = colliding();
    reflecting.description.collision.response.value = "reflect";
    Session session(device, std::move(reflecting));
    std::uint64_t reverted = 0;
    bool have_touched = false;
    for (int k = 0; k < 40; ++k) {
      session.step_once();
      const auto touching = session.simulation().touching_vertices();
      CHECK(touching.size() == session.report().reverted_vertices - reverted);
      have_touched = have_touched || !touching.empty();
      reverted = session.report().reverted_vertices;
    }
    CHECK(have_touched);
  });
}

TEST_CASE("settings change while a scene plays, from the state as it stands", "[gl]") {
  for (const char* timing : {"time_step = 0.002\n", by_tolerance}) {
    on_every_device([&](Device& device) {
      Session session(device, colliding(timing));
      while (session.is_due(0.02)) session.advance_toward(0.02, 10);
      const std::uint64_t step = session.step();
      const double time = session.time();
      const auto motion = motion_of(session);
      Settings settings = session.settings();
      settings.elasticity = 0.5;
      settings.materials[1] = {.stiffness = 400, .vertex_mass = 2, .damping = 0.25};
      session.change(settings);
      CHECK(session.settings() == settings);
      CHECK(session.step() == step);
      CHECK(session.time() == time);
      CHECK(same_bits(motion_of(session), motion));
      session.step_once();
      CHECK(session.step() == step + 1);
      CHECK(session.time() > time);
      REQUIRE(session.step_back());
      CHECK(session.time() == Approx(time));
      CHECK_FALSE(session.step_back());
      session.restart();
      CHECK(session.time() == 0);
      CHECK(session.step() == 0);
      CHECK(session.settings() == settings);
    });
  }
}

TEST_CASE("a change of settings begins all counts anew", "[gl]") {
  LoadedScene scene = colliding();
  const ModelBody& second = scene.start.model.bodies[1];
  std::fill_n(scene.start.state.motion.begin() + 6 * second.first_vertex, 6 * second.vertex_count, 0.0);  // it needs no forces
  on_every_device([&](Device& device) {
    Session session(device, scene);
    session.advance_toward(0.06, 100);
    REQUIRE(session.report().force_evaluations > 0);
    REQUIRE(session.report().forces_skipped > 0);
    REQUIRE(session.report().frame_changes > 0);
    Settings settings = session.settings();
    settings.elasticity = 0.5;
    session.change(settings);
    const StepReport& report = session.report();
    CHECK(report.steps == 0);
    CHECK(report.force_evaluations == 0);
    CHECK(report.pair_interactions == 0);
    CHECK(report.forces_skipped == 0);
    CHECK(report.frame_changes == 0);
  });
}

TEST_CASE("changed settings are those of a scene that has them from the start") {
  const auto device = make_cpu_device(2, 32);
  LoadedScene stiff = colliding();
  for (ModelBody& body : stiff.start.model.bodies) body.stiffness = 90;
  Session from_start(*device, stiff), changed(*device, colliding());
  Settings settings = changed.settings();
  for (Material& material : settings.materials) material.stiffness = 90;
  changed.change(settings);
  changed.restart();
  for (Session* session : {&from_start, &changed}) session->advance_toward(0.08, 100);
  CHECK(same_bits(motion_of(from_start), motion_of(changed)));
}

TEST_CASE("friction, restitution and a tolerance change while a scene plays, too") {
  const auto device = make_cpu_device(1, 32);
  Session session(*device, colliding());
  session.advance_toward(0.02, 100);
  Settings settings = session.settings();
  CHECK((settings.friction == 0.5 && !settings.restitution && !settings.tolerance));
  settings.friction = 0.1;
  settings.restitution = 0.4;
  settings.time_step.reset();
  settings.tolerance = 1e-5;
  session.change(settings);
  CHECK(session.settings() == settings);
  CHECK(session.plan().tolerance == 1e-5);
  CHECK((session.scene().collision.friction == 0.1 && session.scene().collision.restitution == 0.4));
  session.advance_toward(0.1, 1000);
  CHECK(session.report().adaptive.has_value());
}

TEST_CASE("settings without a plan leave a session as it was") {
  const auto device = make_cpu_device(1, 32);
  Session session(*device, colliding());
  session.step_once();
  const Settings before = session.settings();
  Settings bad = before;
  bad.integrator = "srkn11b";  // it bears no damping
  const auto motion = motion_of(session);
  CHECK_THROWS_AS(session.change(bad), Error);
  CHECK(session.settings() == before);
  CHECK(same_bits(motion_of(session), motion));
  session.step_once();
  CHECK(session.step() == 2);
}

TEST_CASE(
    "bodies that intersect can't begin where contacts keep them apart, and others can be changed and restarted in contact") {
  const auto cpu = make_cpu_device(2, 32);
  LoadedScene overlapping = colliding();
  LoadedScene apart = overlapping;
  overlapping.start.state.poses[1].origin[0] = 0.5;
  const Error error = error_of([&] { Session(*cpu, std::move(overlapping)); });
  check_says(error, {"meeting.toml", "\"body0\" and \"body1\"", "m deep", "move them apart", "reflect"});

  Session session(*cpu, std::move(apart));
  while (session.report().contact_steps < 5) session.step_once();
  for (const double stiffness : {1.0, 80.0}) {
    Settings wanted = session.settings();
    for (Material& material : wanted.materials) material.stiffness = stiffness;
    CHECK_NOTHROW(session.change(wanted));
    while (session.report().contact_steps < 5) session.step_once();
  }
  session.restart();
  CHECK(session.step() == 0);
  session.step_once();
  CHECK(session.step() == 1);
}

TEST_CASE("a session draws a body while it is pulled, and not when it is let go", "[gl]") {
  on_every_device([](Device& device) {
    Session pulled(device, colliding()), free(device, colliding());
    pulled.pull(Pull{.vertex = 50, .target = {1, 9, 0}});
    pulled.advance_toward(0.008, 4);
    pulled.pull({});
    pulled.advance_toward(0.016, 4);
    free.advance_toward(0.016, 100);
    const auto end = pulled.simulation().state().world_positions(pulled.model());
    CHECK(end[50].y > free.simulation().state().world_positions(free.model())[50].y + 1e-4);
    REQUIRE(pulled.step() == 8);
  });
}

TEST_CASE("a session's history stays within its memory") {
  const auto device = make_cpu_device(1, 32);
  const std::size_t room = 15 * Session(*device, colliding()).history().bytes();
  Session session(*device, colliding(), room);
  for (int k = 0; k < 200; ++k) {
    session.step_once();
    session.record();
  }
  CHECK(session.history().bytes() <= room);
  CHECK(session.history().size() > 10);
  int steps_back = 0;
  while (session.step_back()) ++steps_back;
  CHECK(steps_back + 1 == static_cast<int>(session.history().size()));
}

TEST_CASE("going back over long ways between states leaves the older ones their room") {
  const auto device = make_cpu_device(1, 32);
  const std::size_t one = Session(*device, colliding()).history().bytes();
  for (const std::size_t room : {50, 20}) {
    Session session(*device, colliding(), room * one);
    for (const double time : {0.16, 0.32, 0.48}) {
      session.advance_toward(time, 80);
      session.record();
    }
    REQUIRE(session.step() == 240);
    std::uint64_t steps_back = 0;
    for (; session.step_back(); ++steps_back) CHECK(session.step() == 239 - steps_back);
    CHECK(steps_back == 240);
  }
}

TEST_CASE("after a step that is not finite nothing is due, and one can go back before it") {
  const auto device = make_cpu_device(1, 32);
  LoadedScene scene = colliding();
  scene.description.simulation.time_step = 10;
  Session session(*device, scene);
  for (int k = 0; k < 1000 && !session.breakdown(); ++k) {
    session.step_once();
    session.record();
  }
  REQUIRE(session.breakdown());
  const std::uint64_t broken = session.step();
  CHECK_FALSE(session.is_due(1e9));
  session.step_once();
  CHECK(session.step() == broken);
  REQUIRE(session.step_back());
  CHECK(session.step() == broken - 1);
  CHECK_FALSE(session.breakdown());
}

TEST_CASE("after a change of settings, too, a step that is not finite has the number that the session gives it") {
  const auto device = make_cpu_device(1, 32);
  Session session(*device, colliding());
  session.advance_toward(0.02, 100);
  REQUIRE(session.step() == 10);
  Settings settings = session.settings();
  settings.time_step = 1e30;
  session.change(settings);
  for (int k = 0; k < 10 && !session.breakdown(); ++k) session.step_once();
  REQUIRE(session.breakdown());
  CHECK(session.breakdown()->step == session.step());
}

TEST_CASE("an OBJ file is a scene of one body at rest") {
  const LoadedScene scene = load(source_dir() + "/meshes/teapot.obj");
  CHECK(scene.description.title == "teapot");
  REQUIRE(scene.description.bodies.size() == 1);
  const auto device = make_cpu_device(1, 32);
  Session session(*device, scene);
  CHECK(session.model().triangles.size() > 100);
  const auto before = motion_of(session);
  session.step_once();
  CHECK(session.step() == 1);
  CHECK(motion_of(session) == before);
}

TEST_CASE("a file that is no scene is an error that names it") {
  const test::ScratchFolder folder;
  const auto bad = folder.path / "bad.obj";
  std::ofstream(bad) << "this is no mesh\n";
  const auto device = make_cpu_device(1, 32);
  const Error no_mesh = error_of([&] { return Session(*device, load(bad)).step(); });
  CHECK(no_mesh.kind() == ErrorKind::input);
  check_says(no_mesh, {"bad.obj"});
  const Error no_scene = error_of([&] { return load(folder.path / "missing.toml"); });
  CHECK(no_scene.kind() == ErrorKind::input);
  check_says(no_scene, {"missing.toml"});
}

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

TEST_CASE("a body that would touch another is not added") {
  const auto device = make_cpu_device(2, 32);
  Session session(*device, boxed());
  session.advance_toward(0.1, 1000);
  const auto before = motion_of(session);
  CHECK_THROWS_WITH(session.add(small_ball({0.3, 0.5, 0})), Catch::Contains("intersect"));
  CHECK(session.model().bodies.size() == 3);
  CHECK(same_bits(motion_of(session), before));
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

TEST_CASE("bodies of a state that is not finite do not change") {
  const auto device = make_cpu_device(1, 32);
  LoadedScene scene = colliding();
  scene.description.simulation.time_step = 1e30;
  Session session(*device, std::move(scene));
  for (int k = 0; k < 10 && !session.breakdown(); ++k) session.step_once();
  REQUIRE(session.breakdown());
  CHECK_THROWS_WITH(session.add(small_ball({-0.5, 1.5, -0.5})), Catch::Contains("not finite"));
  CHECK_THROWS_WITH(session.remove(0), Catch::Contains("not finite"));
  session.restart();
  session.add(small_ball({-0.5, 2.5, -0.5}));
  CHECK(session.model().bodies.size() == 3);
}

}  // namespace
