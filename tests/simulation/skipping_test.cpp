// What steps leave out changes nothing. The oracle is a run that leaves nothing out.
#include "simulation/skipping.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "support/evolve.hpp"
#include "support/has.hpp"
#include "support/impulse_scene.hpp"

namespace pliant {
namespace {

// Layers of spheres at rest, a static cube beside them, and two spheres that fly into them. Some rest within the gap of each
// other, and those of `spacing` 0.82 within an edge. In some scenes there is a floor below.
ModelAndState balls_into_others(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const double spacing = std::vector{0.82, 0.9, 1.1}[seed % 3];
  std::vector<BodySetup> setups;
  const auto add = [&](const char* mesh, const glm::dvec3& place) -> BodyDescription& {
    setups.push_back(soft(generate_mesh(mesh), "ball"));
    setups.back().description.scale = 0.4;
    setups.back().description.position = place;
    return setups.back().description;
  };
  for (int k = 0; k < 12; ++k) add("icosphere:1", spacing * glm::dvec3(k % 3, k / 3 % 2, k / 6));
  add("cube:2", {-1.3, 0, 0}).kind = BodyKind::immovable;
  for (int k = 0; k < 2; ++k) {
    BodyDescription& ball = add("icosphere:1", {1 + unit(random), 0.5 + unit(random), spacing + 1.0 + k});
    ball.velocity = {unit(random), unit(random), -3 - k};
    ball.total_mass = k == 0 ? 0.3 : 3;
  }
  GroundDescription floor;
  floor.normal = {0, 0, 1};
  floor.point = {0, 0, -0.42 - 0.3 * (seed % 2)};
  return build_model(setups, glm::dvec3(0.0), std::vector(seed % 4 < 2 ? 1 : 0, floor));
}

void check_same_results(Simulation& skips, Simulation& does_all) {
  CHECK(skips.state().motion == does_all.state().motion);
  CHECK(skips.world_positions() == does_all.world_positions());
  const StepReport a = skips.report(), b = does_all.report();
  CHECK(a.contact_steps == b.contact_steps);
  CHECK(a.contact_pairs_max == b.contact_pairs_max);
  CHECK(a.reverted_vertices == b.reverted_vertices);
  CHECK(a.substeps == b.substeps);
  CHECK(b.steps_at_rest == 0);
  CHECK(b.forces_skipped == 0);
}

struct Twins {
  Twins(Device& device, const ModelAndState& start, const TimePlan& plan, const CollisionDescription& collision)
      : skips(device, start.model, start.state, plan, collision), does_all(device, start.model, start.state, plan, collision) {
    does_all.skip(skip_nothing);
  }
  void advance(std::uint64_t steps) {
    for (Simulation* simulation : {&skips, &does_all}) simulation->advance(steps);
  }
  Simulation skips, does_all;
};

CollisionDescription answered_by(const char* response) {
  CollisionDescription description;
  description.response = {response};
  description.elasticity = 0.9;
  return description;
}

TEST_CASE("bodies fly into others at rest to the bit as if none were left alone") {
  const auto device = make_cpu_device(2, 32);
  for (const char* response : {"impulse", "reflect"})
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
      CAPTURE(response, seed);
      ModelAndState start = balls_into_others(seed);
      if (std::string_view(response) == "reflect") start.model.grounds.clear();
      Twins runs(*device, start, plan_of({seed % 2 == 0 ? "verlet" : "cv8", seed % 5 == 0 ? 0.005 : 0.002}),
                 answered_by(response));
      for (int look = 0; look < 8; ++look) {
        runs.advance(40);
        check_same_results(runs.skips, runs.does_all);
      }
      CHECK(runs.skips.report().contact_steps > 0);
      CHECK(runs.skips.report().steps_at_rest > 0);
    }
}

TEST_CASE("bodies at rest are left alone to the bit on every device", "[gl]") {
  const ModelAndState start = balls_into_others(5);
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Twins runs(*test.device, start, plan_of({"verlet", 0.005}), answered_by("impulse"));
    runs.advance(60);
    check_same_results(runs.skips, runs.does_all);
    CHECK(runs.skips.report().contact_steps > 0);
    CHECK(runs.skips.report().steps_at_rest > 2 * 60);
  }
}

std::vector<bool> skips_of(const Skipping& skipping) { return {skipping.forces, skipping.rest, skipping.quiet_steps}; }

TEST_CASE("each kind of work has a name of its own, and any of them can be asked for together") {
  std::set<std::string_view> names = {all_skipping_kinds};
  for (const SkippingKind& kind : skipping_kinds) CHECK(names.insert(kind.name).second);
  const std::size_t count = std::size(skipping_kinds);
  for (std::uint32_t chosen = 0; chosen < 1u << count; ++chosen) {
    std::vector<std::string> asked;
    for (std::size_t k = 0; k < count; ++k)
      if ((chosen >> k & 1) != 0) asked.emplace_back(skipping_kinds[k].name);
    for (int order = 0; order < 2; ++order) {
      CAPTURE(asked);
      const Skipping skipping = skipping_without(asked);
      const std::vector<bool> skips = skips_of(skipping);
      CHECK(static_cast<std::size_t>(std::ranges::count(skips, false)) == asked.size());
      for (std::size_t k = 0; k < count; ++k) CHECK(skipping.*skipping_kinds[k].is_skipped == ((chosen >> k & 1) == 0));
      std::ranges::reverse(asked);
    }
  }
  CHECK(skipping_without(std::vector<std::string>{"all"}) == skip_nothing);
  CHECK(skipping_without(std::vector<std::string>{"rest", "all"}) == skip_nothing);
  CHECK(skips_of(skip_nothing) == std::vector(count, false));
  CHECK(skipping_without({}) == Skipping{});
}

constexpr Skipping without_one_kind[] = {{.forces = false}, {.rest = false}, {.quiet_steps = false}};

TEST_CASE("each kind of work can be done alone, with the same bits", "[gl]") {
  const ModelAndState start = balls_into_others(5);
  for (const TestDevice& test : all_devices()) {
    Twins skips_all(*test.device, start, plan_of({"verlet", 0.005}), answered_by("impulse"));
    skips_all.advance(60);
    const std::uint64_t fewest_forces = skips_all.skips.report().force_evaluations;
    for (const Skipping& kind : without_one_kind) {
      CAPTURE(test.name, skips_of(kind));
      Twins runs(*test.device, start, plan_of({"verlet", 0.005}), answered_by("impulse"));
      runs.skips.skip(kind);
      runs.advance(60);
      CHECK(runs.skips.state().motion == runs.does_all.state().motion);
      const StepReport report = runs.skips.report();
      CHECK((report.force_evaluations > fewest_forces) == !kind.forces);
      CHECK((report.steps_at_rest > 0) == kind.rest);
      CHECK(report.quiet_steps == 0);
    }
  }
}

TEST_CASE("steps are quiet on a GPU where none of the kinds of work is done, with the same bits", "[gl]") {
  if (test::lacks_gl()) return;
  const auto device = make_gpu_device(0);
  std::vector<BodySetup> setups(2, soft(generate_mesh("icosphere:1"), "ball"));
  setups[0].description.stretch = {1.1, 0.95, 1};
  setups[1].description.position = {12, 0, 0};
  setups[1].description.velocity = {-1, 0, 0};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  Twins runs(*device, start, plan_of({"verlet", 0.01}), answered_by("impulse"));
  runs.advance(40);
  CHECK(runs.skips.report().quiet_steps > 0);
  CHECK(runs.skips.state().motion == runs.does_all.state().motion);
  for (const Skipping& kind : without_one_kind) {
    CAPTURE(skips_of(kind));
    Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 0.01}), answered_by("impulse"));
    simulation.skip(kind);
    simulation.advance(40);
    CHECK(simulation.report().quiet_steps == 0);
    CHECK(simulation.state().motion == runs.skips.state().motion);
  }
}

TEST_CASE("with a tolerance, too, bodies at rest are left alone to the bit") {
  const auto device = make_cpu_device(2, 64);
  for (const char* response : {"impulse", "reflect"}) {
    CAPTURE(response);
    ModelAndState start = balls_into_others(2);
    Twins runs(*device, start, plan_of(Adaptive{.tolerance = 1e-5}, start.model), answered_by(response));
    for (Simulation* simulation : {&runs.skips, &runs.does_all}) static_cast<void>(simulation->advance_to(0.3));
    check_same_results(runs.skips, runs.does_all);
    CHECK(runs.skips.report().steps == runs.does_all.report().steps);
    CHECK(runs.skips.report().steps_at_rest > 0);
  }
}

TEST_CASE("a body at rest moves when it is pulled, and wakes those that it meets") {
  const auto device = make_cpu_device(1, 32);
  for (const char* response : {"impulse", "reflect"}) {
    CAPTURE(response);
    std::vector<BodySetup> setups(2, soft(generate_mesh("icosphere:1"), "ball"));
    setups[1].description.position = {2.2, 0, 0};
    const ModelAndState start = build_model(setups, glm::dvec3(0.0));
    Twins runs(*device, start, plan_of({"verlet", 0.005}), answered_by(response));
    runs.advance(10);
    CHECK(runs.skips.report().steps_at_rest == 2 * 7);  // of each body three pass until it is known to be at rest
    CHECK(runs.skips.state().motion == start.state.motion);
    for (int step = 0; step < 100; ++step) {
      for (Simulation* simulation : {&runs.skips, &runs.does_all}) simulation->pull({.vertex = 3, .target = {3, 0, 0}}, 0.005);
      runs.advance(1);
    }
    check_same_results(runs.skips, runs.does_all);
    CHECK(runs.skips.report().contact_steps > 0);
    CHECK(runs.skips.report().steps_at_rest < 2 * 100);
  }
}

TEST_CASE("looking at bodies at rest, or saving them, leaves them at rest") {
  const ModelAndState start = balls_into_others(1);
  const auto device = make_cpu_device(1, 32);
  const TimePlan plan = plan_of({"verlet", 0.002});
  for (const char* response : {"impulse", "reflect"}) {
    CAPTURE(response);
    ModelAndState of_response = start;
    if (std::string_view(response) == "reflect") of_response.model.grounds.clear();
    Simulation whole(*device, of_response.model, of_response.state, plan, answered_by(response));
    Simulation resumed(*device, of_response.model, of_response.state, plan, answered_by(response));
    whole.advance(50);
    static_cast<void>(whole.intersections());
    resumed.restore(whole.save());
    for (Simulation* simulation : {&whole, &resumed}) simulation->advance(250);
    CHECK(whole.state().motion == resumed.state().motion);
    CHECK(whole.report().contact_steps > 0);
    CHECK(resumed.report().steps_at_rest > 0);
    CHECK(whole.report().contact_steps == resumed.report().contact_steps);
  }
}

// A ball at rest is hit, and flies past a third one.
TEST_CASE("going back in place, to before a body at rest was hit and forth again, changes no bit") {
  const auto device = make_cpu_device(1, 32);
  std::vector<BodySetup> setups(3, soft(generate_mesh("icosphere:1"), "ball"));
  for (BodySetup& setup : setups) {
    setup.description.scale = 0.4;
    setup.description.total_stiffness = 8000;
  }
  setups[1].description.position = {-3.2, 0, 0};
  setups[1].description.velocity = {6, 0, 0};
  setups[2].description.position = {0.6, -3.9, 0};
  setups[2].description.velocity = {0, 6, 0};
  const ModelAndState start = build_model(setups, glm::dvec3(0.0));
  for (const char* response : {"impulse", "reflect"})
    for (const std::uint64_t hit : {60u, 65u, 70u, 75u}) {
      CAPTURE(response, hit);
      Simulation simulation(*device, start.model, start.state, plan_of({"verlet", 0.01}), answered_by(response));
      const std::string early = simulation.save();
      simulation.advance(hit);
      const std::string late = simulation.save();
      simulation.advance(100);
      const std::vector<double> motion = simulation.state().motion;
      const std::uint64_t pairs_skipped = simulation.report().body_pairs_skipped;
      simulation.restore(early);
      simulation.advance(4);
      CHECK(simulation.report().steps_at_rest > 0);
      simulation.restore(late);
      simulation.advance(100);
      CHECK(simulation.state().motion == motion);
      CHECK(simulation.report().body_pairs_skipped == pairs_skipped);
    }
}

}  // namespace
}  // namespace pliant
