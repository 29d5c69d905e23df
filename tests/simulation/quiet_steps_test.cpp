// Steps in which nothing comes near are made many at once, to the bit as others. The oracle is a run that makes all of each step.
#include <catch2/catch.hpp>
#include <functional>
#include <string_view>
#include <utility>

#include "support/evolve.hpp"
#include "support/has.hpp"
#include "support/impulse_scene.hpp"
#include "support/quiet_scenes.hpp"

namespace pliant {
namespace {

// A run that makes quiet steps, and one that makes none.
struct Runs {
  Runs(Device& device, const ModelAndState& start, const Method& method, bool sleeps = false,
       const CollisionDescription& collision = by_impulses)
      : quiet(device, start.model, start.state, plan(method, sleeps), collision),
        busy(device, start.model, start.state, plan(method, sleeps), collision) {
    busy.skip(skip_nothing);
  }
  static TimePlan plan(const Method& method, bool sleeps) {
    TimePlan plan = plan_of(method);
    plan.sleep = sleeps;
    return plan;
  }
  void advance(std::uint64_t steps) {
    for (Simulation* simulation : {&quiet, &busy}) simulation->advance(steps);
  }
  void check() {
    CHECK(quiet.state().motion == busy.state().motion);
    CHECK(quiet.world_positions() == busy.world_positions());
    const StepReport a = quiet.report(), b = busy.report();
    CHECK(a.steps == b.steps);
    CHECK(a.time == b.time);
    CHECK(a.substeps == b.substeps);
    CHECK(a.contact_steps == b.contact_steps);
    CHECK(a.frame_changes == b.frame_changes);
    CHECK(a.body_pairs_skipped == b.body_pairs_skipped);
    CHECK(a.force_evaluations + a.forces_skipped == b.force_evaluations + b.forces_skipped);
    CHECK(a.energy_slept == b.energy_slept);
    CHECK(a.response.outside_impulse == b.response.outside_impulse);
    CHECK(b.quiet_steps == 0);
  }
  Simulation quiet, busy;
};

TEST_CASE("quiet steps have the bits of others, and end in time for contacts", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  const ModelAndState start = build_model(four_balls(), glm::dvec3(0.0));
  for (const Method& method : {Method{"verlet", 0.01},
                               {"verlet", 0.01, DampingLaw::constant},
                               {"verlet", 0.01, DampingLaw::adaptive},
                               {"cv8", 0.02},
                               {"rk4", 0.01, DampingLaw::adaptive},
                               {"dprkn8", 0.02},
                               {"srkn11b", 0.02}}) {
    CAPTURE(method.integrator, method.time_step);
    Runs runs(*device, start, method);
    for (const std::uint64_t steps : {1, 2, 7, 30, 40, 60, 60}) {
      runs.advance(steps);
      runs.check();
    }
    CHECK(runs.quiet.report().quiet_steps > 20);
    CHECK(runs.quiet.report().steps_at_rest > 0);
    CHECK(runs.busy.report().contact_steps > 0);
  }
}

TEST_CASE("bodies that only reflect, or pass through each other, make quiet steps", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  const ModelAndState start = build_model(four_balls(), glm::dvec3(0.0));
  for (const char* response : {"reflect", "none"})
    for (const Method& method : {Method{"verlet", 0.01, DampingLaw::adaptive}, {"cv8", 0.02}, {"dprkn8", 0.02}}) {
      CAPTURE(response, method.integrator);
      Runs runs(*device, start, method, false, {.response = {response}});
      for (const std::uint64_t steps : {1, 2, 7, 30, 40, 60, 60}) {
        runs.advance(steps);
        runs.check();
      }
      CHECK(runs.quiet.report().quiet_steps > 20);
      CHECK((runs.busy.report().contact_steps > 0) == (response == std::string_view("reflect")));
      const std::string saved = runs.quiet.save();
      runs.advance(20);
      runs.quiet.restore(saved);
      runs.quiet.advance(20);
      runs.check();
    }
}

TEST_CASE("a body alone makes quiet steps, deformed or not, and where it blows up it tells the step", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  for (const double stretch : {1.0, 1.2}) {
    CAPTURE(stretch);
    BodySetup ball = ball_of("icosphere:1", {0, 0, 0});
    ball.description.stretch = {stretch, 1, 1};
    ball.description.velocity = {3, 0, 1};
    const ModelAndState start = build_model(std::vector{ball}, {0, 0, -9.81});
    Runs runs(*device, start, {"cv8", 0.01});
    runs.advance(50);
    runs.check();
    CHECK(runs.quiet.report().quiet_steps > 40);
    const double bound = step_bound(find_integrator("verlet"), start.model.bodies[0], DampingLaw::none);
    Runs grows(*device, start, {"verlet", 2 * bound});
    grows.advance(2000);
    const StepReport quiet = grows.quiet.report(), busy = grows.busy.report();
    CHECK(quiet.breakdown.has_value() == (stretch > 1));
    CHECK(quiet.steps == busy.steps);
    CHECK(quiet.breakdown == busy.breakdown);
  }
}

TEST_CASE("what never moves counts as left alone in quiet steps, too", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  std::vector<BodySetup> setups = {ball_of("icosphere:1", {0, 0, 0}), ball_of("icosphere:0", {60, 0, 0})};
  setups[0].description.velocity = {1, 0, 0};
  setups[1].description.kind = BodyKind::immovable;
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  Runs runs(*device, start, {"verlet", 0.01});
  runs.advance(200);
  runs.check();
  CHECK(runs.quiet.report().quiet_steps > 150);
  CHECK(runs.quiet.report().steps_at_rest > 190);
}

// Both kinds of advance() ask: with steps that may be quiet, and without.
TEST_CASE("a run that was told to stop goes on to the same bits", "[gl]") {
  const ModelAndState start = build_model(four_balls(), glm::dvec3(0.0));
  for (const TestDevice& test : all_devices())
    for (const char* response : {"impulse", "none"}) {
      CAPTURE(test.name, response);
      const CollisionDescription collision{.response = {response}, .elasticity = 0.5};
      Simulation whole(*test.device, start.model, start.state, plan_of(Method{"verlet", 0.01}), collision),
          halting(*test.device, start.model, start.state, plan_of(Method{"verlet", 0.01}), collision);
      whole.advance(150);
      int halts = 0;
      for (std::uint64_t made = 0; made < 150; made = halting.report().steps, ++halts)
        halting.advance(150 - made, [] { return true; });
      CHECK(halts > 1);
      CHECK(halting.report().steps == 150);
      CHECK((halting.state().motion == whole.state().motion));
    }
}

TEST_CASE("a body falls to the ground in quiet steps, and rests in others", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  GroundDescription floor;
  floor.normal = {0, 0, 1};
  floor.point = {0, 0, -5};
  const ModelAndState start = build_model(std::vector{ball_of("icosphere:1", {0, 0, 0})}, {0, 0, -9.81}, std::vector{floor});
  Runs runs(*device, start, {"verlet", 0.005});
  runs.advance(120);
  runs.check();
  const std::uint64_t in_fall = runs.quiet.report().quiet_steps;
  CHECK(in_fall > 60);
  runs.advance(120);
  runs.check();
  CHECK(runs.busy.report().contact_steps > 0);
}

TEST_CASE("what pulls a body or goes on from a saved state leaves quiet steps right", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  const ModelAndState start = build_model(four_balls(), glm::dvec3(0.0));
  Runs runs(*device, start, {"verlet", 0.01});
  runs.advance(10);
  for (Simulation* simulation : {&runs.quiet, &runs.busy}) simulation->pull({.vertex = 60, .target = {0, 12, 0}}, 0.05);
  runs.advance(20);
  runs.check();
  const std::string saved = runs.quiet.save();
  runs.advance(20);
  runs.check();
  runs.quiet.restore(saved);
  runs.quiet.advance(20);
  runs.check();
  CHECK(runs.quiet.report().quiet_steps > 10);
}

TEST_CASE("bodies that several work groups serve make quiet steps", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  if (device->shares_at_once() == 0) return test::skip("groups of this device do not wait for each other");
  std::vector<BodySetup> setups = {ball_of("icosphere:3", {0, 0, 0}), ball_of("icosphere:3", {12, 0.3, 0})};
  setups[0].description.stretch = {1.1, 0.95, 1};
  setups[0].description.spin = {0, 2, 1};
  setups[1].description.velocity = {-6, 0, 0};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  for (const char* response : {"impulse", "reflect"})
    for (const Method& method : {Method{"verlet", 0.001}, {"cv8", 0.002}, {"dprkn8", 0.002}, {"srkn11b", 0.002}}) {
      CAPTURE(response, method.integrator);
      Runs runs(*device, start, method, false, {.response = {response}, .elasticity = 0.5});
      for (const std::uint64_t steps : {100, 700, 1000}) {
        runs.advance(steps);
        runs.check();
      }
      CHECK(runs.quiet.report().quiet_steps > 100);
      CHECK(runs.quiet.report().frame_changes > 20);  // of which most are in quiet steps
    }
}

TEST_CASE("quiet steps go on in further dispatches, with the same bits", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  if (device->shares_at_once() == 0) return test::skip("groups of this device do not wait for each other");
  BodySetup ball = ball_of("icosphere:1", {0, 0, 0});
  ball.description.stretch = {1.1, 0.95, 1};
  Runs runs(*device, build_model(std::vector{ball}, glm::dvec3(0.0)), {"verlet", 0.001}, false);
  runs.advance(2 * physics::most_quiet_steps + 100);
  runs.check();
  CHECK(runs.quiet.report().quiet_steps > 2 * physics::most_quiet_steps);
}

// Of bodies that several work groups serve, some move among others at rest. While those that move have a group for each share,
// steps are quiet. The first one flies at a row of others, so that ever more of them move.
TEST_CASE("a large body that moves among many at rest makes quiet steps, until more move than there are groups for", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  const auto groups = static_cast<int>(device->shares_at_once());
  if (groups < 65) return test::skip("too few groups of this device wait for each other");  // a body has as many
  const int count = groups / 4;
  for (const int moving : {1, count / 2}) {
    std::vector<BodySetup> setups;
    for (int k = 0; k < count; ++k) {
      setups.push_back(ball_of("icosphere:3", {2.5 * (k % 8), 12.0 * (k / 8), 0}));
      if (k * moving % count < moving) setups.back().description.velocity = {0.5, 0.1 * (k % 3), 0};
    }
    setups[0].description.position = {-1.5, 0.1, 0};  // the next one is nearly 2 m away, which takes 95 or 190 steps
    setups[0].description.velocity = {20, 0, 0};
    setups[0].description.stretch = {1.1, 0.95, 1};
    setups[0].description.spin = {0, 2, 1};
    const ModelAndState start = build_model(setups, glm::dvec3(0.0));
    for (const char* response : {"impulse", "reflect"})
      for (const Method& method : {Method{"verlet", 0.0005}, {"verlet", 0.0005, DampingLaw::constant}, {"cv8", 0.001}}) {
        CAPTURE(moving, response, method.integrator);
        Runs runs(*device, start, method, false, {.response = {response}, .elasticity = 0.5});
        for (const std::uint64_t steps : {40, 260}) {
          runs.advance(steps);
          runs.check();
        }
        CHECK((runs.quiet.report().quiet_steps > 20) == (moving == 1));
        CHECK(runs.busy.report().contact_steps > 0);
      }
  }
}

// So many that each has a thread a vertex. Those of 162 vertices have three shares: 180 of them need 45 multiprocessors.
TEST_CASE("bodies whose few shares have a thread a vertex make quiet steps together", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  if (device->shares_at_once() < 60) return test::skip("too few groups of this device wait for each other");
  struct Kind {
    int of_one_share;
    bool self_contact;
    const char* response;
  };
  for (const Kind& kind :
       {Kind{0, false, "impulse"}, {0, false, "reflect"}, {30, false, "impulse"}, {30, false, "reflect"}, {0, true, "impulse"}})
    for (const Method& method : {Method{"verlet", 0.001}, {"cv8", 0.002}}) {
      CAPTURE(kind.of_one_share, kind.self_contact, kind.response, method.integrator);
      std::vector<BodySetup> setups;
      for (int k = 0; k < 60 + kind.of_one_share; ++k) {
        setups.push_back(ball_of(k % 3 == 0 && k / 3 < kind.of_one_share ? "icosphere:1" : "icosphere:2",
                                 {12.0 * (k % 8), 12.0 * (k / 8), 0}));
        setups.back().description.stretch = {1.1, 0.95, 1};
        setups.back().description.spin = {0, 2, 1};
        setups.back().description.self_contact = kind.self_contact;
      }
      const ModelAndState start = build_model(setups, glm::dvec3(0.0));
      const DeviceBodies bodies(*device, start.model, start.state);
      REQUIRE(bodies.force_groups.size() == 1);
      CHECK(device->force_variants()[bodies.force_groups[0].variant].lanes == 1);
      CHECK_FALSE(bodies.force_groups[0].has_whole_bodies);
      Runs runs(*device, start, method, false, {.response = {kind.response}, .elasticity = 0.5});
      for (const std::uint64_t steps : {20, 200}) {
        runs.advance(steps);
        runs.check();
      }
      CHECK(runs.quiet.report().quiet_steps > 100);
      CHECK(runs.quiet.report().frame_changes > 0);
    }
}

// Returns how many steps were quiet, and how many were made, of a ball that meets itself and begins with these velocities.
std::pair<std::uint64_t, std::uint64_t> steps_of_star(Device& device, const Method& method,
                                                      const std::function<glm::dvec3(const glm::dvec3&)>& velocity) {
  BodySetup ball = ball_of("icosphere:1", {0, 0, 0});
  ball.description.self_contact = true;
  ball.description.stretch = {1.1, 0.95, 1};
  ModelAndState start = build_model(std::vector{ball}, {0, -9.81, 0});
  set_velocities(start, velocity);
  Runs runs(device, start, method);
  for (const std::uint64_t steps : {1, 2, 7, 20, 30}) {
    runs.advance(steps);
    runs.check();
  }
  return {runs.quiet.report().quiet_steps, runs.quiet.report().steps};
}

TEST_CASE("a body that may meet itself makes quiet steps while its surface is a star, and no others", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  for (const Method& method : {Method{"verlet", 0.01}, {"cv8", 0.01}}) {
    CAPTURE(method.integrator);
    const auto [calm, of_calm] = steps_of_star(*device, method, [](const glm::dvec3& x) { return glm::dvec3(3 - x.y, x.x, 0); });
    CHECK(calm > of_calm / 3);
    const auto [folding, of_folding] = steps_of_star(*device, method, [](const glm::dvec3& x) { return -60.0 * x; });
    CHECK(folding < of_folding / 3);
  }
}

// A work group serves several of them, on a device in software all.
TEST_CASE("many bodies make quiet steps, or none if a device would stop their loops", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  const bool is_software = device->shares_at_once() == 0;
  struct Many {
    const char* mesh;
    int count;
  };
  for (const Many& many : {Many{"icosphere:1", is_software ? 3 : 600}, {"cube:1", is_software ? 5 : 40}, {"icosphere:1", 16}}) {
    CAPTURE(many.mesh, many.count);
    std::vector<BodySetup> setups;
    for (int k = 0; k < many.count; ++k) {
      setups.push_back(ball_of(many.mesh, {12.0 * (k % 16), 12.0 * (k / 16), 0}));
      setups.back().description.stretch = {1.1, 0.95, 1};
      setups.back().description.spin = {0, 2, 1};
    }
    const ModelAndState start = build_model(setups, glm::dvec3(0.0));
    for (const Method& method : {Method{"dop853", 0.02}, {"verlet", 0.01}}) {
      CAPTURE(method.integrator);
      Runs runs(*device, start, method);
      runs.advance(20);
      runs.check();
      const bool has_many_stages = method.integrator == "dop853";
      CHECK((runs.quiet.report().quiet_steps > 4) == !(is_software && many.count == 16 && has_many_stages));
      CHECK(runs.quiet.report().frame_changes > 0);
    }
  }
}

// Of more bodies than are compared with each other, those that move are compared with all.
TEST_CASE("a body that moves among thousands at rest makes quiet steps, and thousands that move make none", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  if (device->shares_at_once() == 0) return;  // in software a step of so many would be stopped
  constexpr int count = 1300;
  for (const int moving : {1, 70, count}) {
    CAPTURE(moving);
    std::vector<BodySetup> setups;
    for (int k = 0; k < count; ++k) {
      setups.push_back(ball_of(k % 7 == 0 ? "icosphere:1" : "cube:1", {12.0 * (k % 40), 12.0 * (k / 40), 0}));
      if (k * moving % count < moving) setups.back().description.velocity = {0.5, 0.1 * (k % 3), 0};
    }
    setups[0].description.stretch = {1.1, 0.95, 1};
    setups[0].description.spin = {0, 2, 1};
    const ModelAndState start = build_model(setups, glm::dvec3(0.0));
    for (const char* method : {"verlet", "dop853"}) {
      Runs runs(*device, start, {method, 0.02});
      runs.advance(20);
      runs.check();
      CHECK((runs.quiet.report().quiet_steps > 4) == (moving < count));
    }
  }
}

// The first of 400 bodies is deformed. Returns the variants that serve them.
std::vector<std::size_t> variants_of(Device& device, const glm::dvec3& acceleration) {
  std::vector<BodySetup> setups;
  for (int k = 0; k < 400; ++k) setups.push_back(ball_of("icosphere:3", {12.0 * k, 0, 0}));
  setups[0].description.stretch = {1.1, 1, 1};
  const ModelAndState start = build_model(setups, acceleration);
  const DeviceBodies bodies(device, start.model, start.state);
  std::vector<std::size_t> variants;
  for (const ForceGroup& group : bodies.force_groups) variants.push_back(group.variant);
  return variants;
}

// tests/state/force_groups_test.cpp has what follows from that.
TEST_CASE("whether bodies move from the start, or gravity will move them, decides how threads share springs", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  if (device->shares_at_once() == 0) return test::skip("software has one way for all");
  CHECK(variants_of(*device, glm::dvec3(0.0)) != variants_of(*device, {0, -9.81, 0}));
}

TEST_CASE("bodies that sleep or never move are left alone in quiet steps", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  std::vector<BodySetup> setups(3, ball_of("icosphere:1", {0, 0.45, 0}));
  for (BodySetup& setup : setups) {
    setup.description.scale = 0.4;
    setup.description.total_stiffness = 4000;
  }
  setups[0].description.damping = 2;
  setups[1].description.position = {200, 60, 0};
  setups[1].description.velocity = {0, 20, 0};
  setups[1].description.stretch = {1.1, 0.95, 1};
  setups[2].description.position = {100, 60, 0};
  setups[2].description.kind = BodyKind::immovable;
  const GroundDescription floor;
  const ModelAndState start = build_model(setups, {0, -9.81, 0}, {&floor, 1});
  Runs runs(*device, start, {"verlet", 0.004, DampingLaw::constant}, true);
  for (const std::uint64_t steps : {300, 150, 100}) {
    runs.advance(steps);
    runs.check();
  }
  CHECK(runs.quiet.report().bodies_asleep == 1);
  CHECK(runs.quiet.report().energy_slept > 0);
  CHECK(runs.quiet.report().quiet_steps > 50);
}

TEST_CASE("where all bodies rest all steps are quiet but the first", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  const std::vector<BodySetup> setups = {ball_of("cube:1", {0, 0, 0}), ball_of("cube:1", {5, 0, 0})};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  for (const char* method : {"verlet", "dop853"}) {
    Runs runs(*device, start, {method, 0.01});
    runs.advance(100);
    runs.check();
    CHECK(runs.quiet.report().quiet_steps > 50);
  }
}

TEST_CASE("where no body can move no step is quiet, and steps go on", "[gl]") {
  std::vector<BodySetup> setups = {ball_of("icosphere:1", {0, 0, 0}), ball_of("icosphere:1", {5, 0, 0})};
  for (BodySetup& setup : setups) setup.description.kind = BodyKind::immovable;
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Simulation simulation(*test.device, start.model, start.state, plan_of(Method{"verlet", 0.01}), by_impulses);
    simulation.advance(10);
    CHECK(simulation.report().steps == 10);
    CHECK(simulation.report().quiet_steps == 0);
    CHECK(simulation.state().motion == start.state.motion);
  }
}

TEST_CASE("only a device that knows quiet steps makes them") {
  const auto device = make_cpu_device(1, 32);
  const ModelAndState start = build_model(four_balls(), glm::dvec3(0.0));
  Runs runs(*device, start, {"verlet", 0.01});
  runs.advance(40);
  runs.check();
  CHECK(runs.quiet.report().quiet_steps == 0);
}

}  // namespace
}  // namespace pliant
