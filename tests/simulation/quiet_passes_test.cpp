// What quiet steps leave on the device, and when they are undone. The oracle makes whole steps.
#include <catch2/catch.hpp>
#include <map>
#include <span>
#include <utility>

#include "simulation/quiet_steps.hpp"
#include "support/device_bench.hpp"
#include "support/has.hpp"
#include "support/impulse_scene.hpp"
#include "support/quiet_scenes.hpp"
#include "support/shared_phases.hpp"

namespace pliant {
namespace {

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

// Makes whole steps in turn with quiet ones. A stage of a whole step is a dispatch, or all of them are one. Returns also whether
// a quiet step was undone.
std::pair<std::vector<Turn>, bool> quiet_turns(const ModelAndState& start, const Method& method, int count,
                                               const CollisionDescription& collision, bool all_stages) {
  Bench bench(make_gpu_device(0), start, method, collision);
  bench.bodies.run_all_stages(all_stages);
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
bool check_turns(const ModelAndState& start, const Method& method, int count, const CollisionDescription& collision,
                 bool all_stages = true) {
  const auto [turns, was_undone] = quiet_turns(start, method, count, collision, all_stages);
  CHECK(turns.back().steps > turns.size());
  Bench bench(make_gpu_device(0), start, method, collision);
  bench.bodies.run_all_stages(all_stages);
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
  for (const bool all_stages : {true, false})
    for (const char* integrator : {"verlet", "cv8", "dprkn8"}) {
      CAPTURE(all_stages, integrator);
      CHECK_FALSE(check_turns(start, {integrator, 0.01}, 8, by_impulses, all_stages));
    }
}

TEST_CASE("quiet steps of a large body leave all that other steps leave, while others rest", "[gl]") {
  if (test::lacks_gl()) return;
  if (make_gpu_device(0)->shares_at_once() < 65) return test::skip("too few groups of this device wait for each other");
  std::vector<BodySetup> setups(24, ball_of("icosphere:3", {0, 0, 0}));
  for (std::size_t k = 0; k < setups.size(); ++k) setups[k].description.position = {9.0 * static_cast<double>(k), 0, 0};
  setups[2].description.stretch = {1.1, 0.95, 1};
  setups[2].description.spin = {0, 2, 1};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  for (const char* integrator : {"verlet", "cv8", "dprkn8"}) {
    CAPTURE(integrator);
    CHECK_FALSE(check_turns(start, {integrator, 0.001}, 8, by_impulses, false));
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
      : bench(make_gpu_device(0), build_model(setups, glm::dvec3(0.0)), {"verlet", step}, by_impulses),
        quiet(quiet_steps_of(bench)) {
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

TEST_CASE("where work groups do not run at once no quiet step is made, and nothing changes", "[gl]") {
  if (test::lacks_gl()) return;
  Bench bench(make_gpu_device(0), build_model(four_balls(), glm::dvec3(0.0)), {"verlet", 0.01}, by_impulses);
  bench.bodies.run_all_stages(true);
  QuietSteps quiet(bench.bodies, bench.stepper, bench.collider);
  bench.begin();
  bench.device->run(bench.step(0));
  const auto before = carried_by(bench, 1);
  const physics::QuietSteps asked{.end = 3, .undone = ~0u, .arrivals = physics::waited_in_vain, .begun = 0, .moving_shares = 0};
  bench.bodies.arrays.get<physics::QuietSteps>("quiet_steps").upload(std::span(&asked, 1));
  bench.device->run(quiet.passes(1));
  CHECK(quiet.take_made() == 0);
  CHECK_FALSE(quiet.are_known());
  CHECK((carried_by(bench, 1) == before));
}

}  // namespace
}  // namespace pliant
