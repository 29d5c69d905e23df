// Scenes that go on, back and back to the start, on every device and without a window.
#include "view/session.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <functional>

#include "gl/context.hpp"
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

// A pressed sphere, whose clusters are listed anew soon, and again later.
LoadedScene clustered_sphere() {
  const test::ScratchFolder folder;
  const auto file = folder.path / "dense.toml";
  std::ofstream(file) << "[simulation]\nintegrator = \"verlet\"\ntime_step = 0.002\n"
                         "[[body]]\nmesh = \"icosphere:3\"\nstretch = [1, 1, 0.1]\ntotal_stiffness = 2000\ntotal_mass = 1\n"
                         "damping = 0\nforces = \"clustered\"\n";
  return load(file);
}

TEST_CASE("a session with a clustered body goes back to the bit across new lists, and keeps them when settings change", "[gl]") {
  on_every_device([](Device& device) {
    Session session(device, clustered_sphere());
    std::vector<std::vector<double>> motions{motion_of(session)};
    for (int k = 0; k < 70; ++k) {
      session.step_once();
      session.record();
      motions.push_back(motion_of(session));
    }
    REQUIRE(session.simulation().report().clusters->lists_made > 0);
    for (std::size_t step = 70; step-- > 0;) {
      REQUIRE(session.step_back());
      CHECK(same_bits(motion_of(session), motions[step]));
    }
    for (int k = 0; k < 70; ++k) session.step_once();
    CHECK(same_bits(motion_of(session), motions.back()));
    const auto lists = session.simulation().state().changed_sums;
    REQUIRE(lists[0] != nullptr);
    Settings settings = session.settings();
    settings.time_step = 0.001;
    session.change(settings);
    CHECK(session.simulation().state().changed_sums == lists);
    session.step_once();
    session.restart();
    CHECK(same_bits(motion_of(session), motions.front()));
  });
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

TEST_CASE("bodies of a state that is not finite do not change") {
  const auto device = make_cpu_device(1, 32);
  LoadedScene scene = colliding();
  scene.description.simulation.time_step = 1e30;
  Session session(*device, std::move(scene));
  for (int k = 0; k < 10 && !session.breakdown(); ++k) session.step_once();
  REQUIRE(session.breakdown());
  check_says(error_of([&] { session.remove(0); }), {"not finite"});
  session.restart();
  session.remove(0);
  CHECK(session.model().bodies.size() == 1);
}

}  // namespace
