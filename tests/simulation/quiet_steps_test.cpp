// Steps in which nothing comes near are made many at once, to the bit as others. The oracle is a run that makes all of each step.
#include "simulation/quiet_steps.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include "support/device_bench.hpp"
#include "support/evolve.hpp"
#include "support/has.hpp"
#include "support/impulse_scene.hpp"
#include "support/shared_phases.hpp"

namespace pliant {
namespace {

BodySetup ball_of(const char* mesh, const glm::dvec3& place) {
  BodySetup setup = soft(generate_mesh(mesh), "ball");
  setup.description.position = place;
  return setup;
}

// One turns and vibrates, one comes towards it undeformed, one rests and one turns aside.
std::vector<BodySetup> four_balls() {
  std::vector<BodySetup> setups = {ball_of("icosphere:1", {0, 0, 0}), ball_of("icosphere:0", {12, 0.3, 0}),
                                   ball_of("icosphere:1", {0, 9, 0}), ball_of("cube:1", {0, 0, -9})};
  setups[0].description.stretch = {1.1, 0.95, 1};
  setups[0].description.spin = {0, 2, 1};
  setups[1].description.velocity = {-6, 0, 0};
  setups[3].description.velocity = {0.1, 0, -0.2};
  setups[3].description.spin = {0.5, 0, 0};
  return setups;
}

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

std::unique_ptr<Device> gpu() { return make_gpu_device(0); }

TEST_CASE("quiet steps have the bits of others, and end in time for contacts", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = gpu();
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
  const auto device = gpu();
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
  const auto device = gpu();
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
  const auto device = gpu();
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
  const auto device = gpu();
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
  const auto device = gpu();
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

// All that steps from this half on depend on. What each step begins with finding anew is left out.
std::map<std::string, std::vector<std::byte>> carried_by(const Bench& bench, std::uint32_t half) {
  std::map<std::string, std::vector<std::byte>> bytes;
  for (CarriedArray array : bench.bodies.arrays.carried()) {
    if (array.name == "cluster" || array.name == "slow_place") continue;
    const bool has_halves = array.name == "motion" || array.name == "world_position";
    if (has_halves) array.byte_count /= 2, array.first_byte = half * array.byte_count;
    bytes[array.name].resize(array.byte_count);
    bench.device->read(array.buffer, array.first_byte, bytes[array.name]);
  }
  // that steps were quiet
  auto control = bench.bodies.control.download();
  control[0].total_low[physics::quiet_steps_made] = 0;
  const auto told = std::as_bytes(std::span(control));
  bytes["control"].assign(told.begin(), told.end());
  return bytes;
}

struct Turn {
  std::uint32_t steps;  // so far
  std::map<std::string, std::vector<std::byte>> carried;
};

// Makes whole steps in turn with quiet ones. Returns also whether one of these was undone.
std::pair<std::vector<Turn>, bool> quiet_turns(const ModelAndState& start, const Method& method, int count,
                                               const CollisionDescription& collision) {
  Bench bench(gpu(), start, method, collision);
  bench.bodies.run_all_stages(true);
  QuietSteps quiet(bench.bodies, bench.stepper, bench.collider);
  REQUIRE(quiet.are_known());
  std::vector<Turn> turns;
  bool was_undone = false;
  std::uint32_t steps = 0;
  bench.begin();
  while (count-- > 0) {
    bench.device->run(bench.step(steps++ % 2));
    quiet.aim_at(3);
    fill_shared_memory(bench.bodies.arrays, std::byte{0xff});
    bench.device->run(quiet.passes(steps % 2));
    was_undone = was_undone || bench.bodies.arrays.get<physics::QuietSteps>("quiet_steps").download()[0].undone != ~0u;
    steps += quiet.take_made();
    turns.push_back({steps, carried_by(bench, steps % 2)});
  }
  return {turns, was_undone};
}

// The oracle makes whole steps alone. Returns whether a quiet step was undone. One device at a time is the thread's own.
bool check_turns(const ModelAndState& start, const Method& method, int count, const CollisionDescription& collision) {
  const auto [turns, was_undone] = quiet_turns(start, method, count, collision);
  CHECK(turns.back().steps > turns.size());
  Bench bench(gpu(), start, method, collision);
  bench.bodies.run_all_stages(true);
  bench.begin();
  std::uint32_t steps = 0;
  for (const Turn& turn : turns) {
    while (steps < turn.steps) bench.device->run(bench.step(steps++ % 2));
    for (const auto& [name, bytes] : carried_by(bench, steps % 2)) {
      CAPTURE(name, steps);
      CHECK((turn.carried.at(name) == bytes));
    }
  }
  return was_undone;
}

TEST_CASE("quiet steps leave all that other steps leave", "[gl]") {
  if (test::lacks_gl()) return;
  const ModelAndState start = build_model(four_balls(), glm::dvec3(0.0));
  for (const char* integrator : {"verlet", "cv8"}) {
    CAPTURE(integrator);
    CHECK_FALSE(check_turns(start, {integrator, 0.01}, 8, by_impulses));
  }
}

TEST_CASE("a step that takes a vertex out of its body's room is made again, with a search", "[gl]") {
  if (test::lacks_gl()) return;
  const ModelAndState start = build_model(four_balls(), glm::dvec3(0.0));
  for (const char* integrator : {"verlet", "cv8"}) CHECK(check_turns(start, {integrator, 0.02}, 30, {.response = {"reflect"}}));
}

// Bodies after a step that was not quiet, and what quiet steps make of them.
struct AfterStep {
  explicit AfterStep(const std::vector<BodySetup>& setups)
      : bench(gpu(), build_model(setups, glm::dvec3(0.0)), {"verlet", step}, by_impulses), quiet(quiet_steps_of(bench)) {
    bench.begin();
    bench.device->run(bench.step(0));
  }
  static QuietSteps quiet_steps_of(Bench& bench) {
    bench.bodies.run_all_stages(true);
    return {bench.bodies, bench.stepper, bench.collider};
  }
  // Vertex 0 is made to expect another velocity along y.
  void expect_more(float velocity) {
    const BufferId surplus = bench.bodies.arrays.buffer("surplus");
    std::vector<float> expected(bench.device->size_of(surplus) / sizeof(float));
    bench.device->read(surplus, 0, std::as_writable_bytes(std::span(expected)));
    expected[physics::expected_surplus_of(0) + 1] += velocity / step;
    bench.device->write(surplus, 0, std::as_bytes(std::span(expected)));
  }
  // Three steps are asked for. If none is made, nothing has changed.
  void check_makes(std::uint32_t steps) {
    const auto before = carried_by(bench, 1);
    quiet.aim_at(3);
    bench.device->run(quiet.passes(1));
    CHECK((bench.bodies.arrays.get<physics::QuietSteps>("quiet_steps").download()[0].undone == 0) == (steps == 0));
    CHECK(quiet.take_made() == steps);
    if (steps > 0) return;
    for (const auto& [name, bytes] : carried_by(bench, 1)) {
      CAPTURE(name);
      CHECK((before.at(name) == bytes));
    }
  }

  static constexpr float step = 0.01f;
  Bench bench;
  QuietSteps quiet;
};

std::vector<BodySetup> two_balls() {
  std::vector<BodySetup> setups = {ball_of("icosphere:1", {0, 0, 0}), ball_of("icosphere:1", {12, 0, 0})};
  setups[0].description.stretch = {1.1, 0.95, 1};
  setups[1].description.velocity = {1, 0, 0};
  return setups;
}

// It flies aside, and is made to expect the opposite.
TEST_CASE("a step that moves a vertex out of its cage is no quiet one", "[gl]") {
  if (test::lacks_gl()) return;
  std::vector<BodySetup> setups = two_balls();
  setups[0].description.velocity = {0, 300, 0};
  for (const bool foresees : {true, false}) {
    CAPTURE(foresees);
    AfterStep after(setups);
    if (!foresees) after.expect_more(-600);
    after.check_makes(foresees ? 3 : 0);
  }
}

TEST_CASE("a step that surprises a body which may meet itself is no quiet one", "[gl]") {
  if (test::lacks_gl()) return;
  constexpr float tenth_of_edge = 0.055f;
  for (const bool self_contact : {false, true}) {
    CAPTURE(self_contact);
    std::vector<BodySetup> setups = two_balls();
    setups[0].description.self_contact = self_contact;
    AfterStep after(setups);
    after.expect_more(tenth_of_edge / AfterStep::step);
    after.check_makes(self_contact ? 0 : 3);
  }
}

TEST_CASE("bodies that several work groups serve make quiet steps", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = gpu();
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
  const auto device = gpu();
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
  const auto device = gpu();
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
  const auto device = gpu();
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

TEST_CASE("bodies that sleep or never move are left alone in quiet steps", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = gpu();
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

TEST_CASE("where work groups do not run at once no quiet step is made, and nothing changes", "[gl]") {
  if (test::lacks_gl()) return;
  Bench bench(gpu(), build_model(four_balls(), glm::dvec3(0.0)), {"verlet", 0.01}, by_impulses);
  bench.bodies.run_all_stages(true);
  QuietSteps quiet(bench.bodies, bench.stepper, bench.collider);
  bench.begin();
  bench.device->run(bench.step(0));
  const auto before = carried_by(bench, 1);
  const physics::QuietSteps asked{.end = 3, .undone = ~0u, .arrivals = physics::waited_in_vain, .begun = 0, .moving_bodies = 0};
  bench.bodies.arrays.get<physics::QuietSteps>("quiet_steps").upload(std::span(&asked, 1));
  bench.device->run(quiet.passes(1));
  CHECK(quiet.take_made() == 0);
  CHECK_FALSE(quiet.are_known());
  CHECK((carried_by(bench, 1) == before));
}

TEST_CASE("where all bodies rest all steps are quiet but the first", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = gpu();
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
