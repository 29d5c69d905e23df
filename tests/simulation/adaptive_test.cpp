// Steps that a tolerance governs, on every device: accuracy, undone steps, exact times, determinism, contacts.
#include <bit>
#include <catch2/catch.hpp>
#include <cstring>

#include "dynamics/automatic_integrator.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "simulation/breakdown.hpp"
#include "support/collision_scene.hpp"
#include "support/expect_error.hpp"
#include "support/oscillator.hpp"
#include "support/shipped_scenes.hpp"

namespace pliant {
namespace {

CollisionDescription with_response(Named response) {
  CollisionDescription collision;
  collision.response = response;
  return collision;
}

struct Run {
  Run(Device& device, const ModelAndState& start, const Adaptive& adaptive, const CollisionDescription& collision)
      : simulation(device, start.model, start.state, plan_of(adaptive, start.model), collision) {}
  Run(Device& device, const ModelAndState& start, const Adaptive& adaptive, Named response = Named{"none"})
      : Run(device, start, adaptive, with_response(response)) {}
  Simulation simulation;
};

// A body that is squashed, slides and turns.
ModelAndState squashed() {
  BodySetup setup = sphere(1);
  setup.description.stretch = {1.2, 0.85, 1.05};
  setup.description.velocity = {1, 2, -0.5};
  setup.description.spin = {0.3, -0.2, 0.5};
  return built(setup, {0, -1, 0});
}

bool same_bits(const State& a, const State& b) {
  return a.motion.size() == b.motion.size() &&
         std::memcmp(a.motion.data(), b.motion.data(), a.motion.size() * sizeof(double)) == 0;
}

// A step by other weights than the method's.
Oscillator after_step(const Integrator& integrator, const std::vector<long double>& weights, const Oscillator& start, double h) {
  const auto step = [&](auto method) {
    method.b = weights;
    return after_step(method, start, h);
  };
  if (const auto* method = std::get_if<Nystrom>(&integrator.method)) return step(*method);
  return step(std::get<RungeKutta>(integrator.method));
}

// World positions without their fourth component, which means nothing.
std::vector<glm::vec3> drawn_positions(Simulation& simulation) {
  std::vector<glm::vec3> positions;
  for (const glm::vec4& position : simulation.world_positions()) positions.emplace_back(position);
  return positions;
}

double largest_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = larger(largest, glm::length(a[i] - b[i]));
  return largest;
}

}  // namespace

TEST_CASE("steps that a tolerance governs have the same bits, however many are queued at a time") {
  const auto device = make_cpu_device(2, 32);
  const ModelAndState start = squashed();
  const double time = 5 / stiffest_omega(start.model);
  const Adaptive adaptive{};
  Run all_at_once(*device, start, adaptive), few(*device, start, adaptive);
  const StepReport expected = all_at_once.simulation.advance_to(time);
  CHECK(expected.steps > 5);
  for (std::uint64_t most = 1; few.simulation.report().time < time; most = most % 4 + 1)
    few.simulation.advance_toward(time, most);
  CHECK(few.simulation.report() == expected);
  CHECK(same_bits(few.simulation.state(), all_at_once.simulation.state()));
}

TEST_CASE("the error of a run follows the tolerance") {
  const auto device = make_cpu_device(2, 64);
  const ModelAndState start = squashed();
  const double time = 20 / stiffest_omega(start.model);
  const auto exact = evolve(*device, start, {"vern8", time / 2000}, 2000).world_positions(start.model);
  for (const char* integrator : {"dop853", "verner78_8", "vern8", "dprkn8", "dprkn12"}) {
    double before = 1;
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      CAPTURE(integrator, tolerance);
      Run run(*device, start, {integrator, tolerance});
      const StepReport report = run.simulation.advance_to(time);
      CHECK(report.time == time);
      const double error = largest_distance(run.simulation.state().world_positions(start.model), exact);
      CHECK(error < 30 * tolerance);
      CHECK(error < before / 10);
      before = error;
    }
  }
}

// The steps of runs with several tolerances in all. At the adaptive law's kink it is chance which steps of one run are rejected.
std::uint64_t steps_taken(Device& device, const ModelAndState& start, DampingLaw law) {
  std::uint64_t steps = 0;
  for (const double tolerance : {1e-4, 3e-5, 1e-5, 1e-6, 1e-7}) {
    if (law == DampingLaw::adaptive && tolerance < 1e-5) continue;  // it would take thousands of steps
    const Adaptive adaptive{automatic_integrator(tolerance, law).name, tolerance, {}, law};
    steps += Run(device, start, adaptive).simulation.advance_to(20 / stiffest_omega(start.model)).steps;
  }
  return steps;
}

// dprkn12's steps are so long that its estimate sees the rounding of forces. It needs the fewest forces all the same.
TEST_CASE("where auto meets tolerances, fp32 forces take at most a quarter more steps than fp64, and dprkn12 two fifths",
          "[gl]") {
  const ModelAndState start = squashed();
  for (const DampingLaw law : {DampingLaw::none, DampingLaw::constant, DampingLaw::adaptive}) {
    const auto exact = make_cpu_device(2, 64);
    const auto steps = static_cast<double>(steps_taken(*exact, start, law));
    for (const TestDevice& test : all_devices()) {
      CAPTURE(test.name, static_cast<int>(law), steps);
      CHECK(static_cast<double>(steps_taken(*test.device, start, law)) <= (law == DampingLaw::none ? 1.4 : 1.25) * steps);
    }
  }
}

TEST_CASE("the next step's length follows from how far the embedded methods come apart on an oscillator") {
  BodySetup setup = two_vertices();
  setup.description.stretch = {1.2, 1, 1};
  const ModelAndState start = built(setup);
  const double omega = stiffest_omega(start.model);
  for (const char* name : {"dop853", "verner78_8", "vern8", "dprkn8", "dprkn12"}) {
    CAPTURE(name);
    const Integrator& integrator = find_integrator(name);
    const StagedMethod& method = *staged_method(integrator);
    const double h = (integrator.order > 8 ? 2.0 : 0.8) / omega;  // long enough for an error above rounding
    const Oscillator start_of_vertex{.omega = omega, .x = 0.1};   // each vertex is an oscillator, 0.1 m off
    const Oscillator end = after_step(integrator, method.b, start_of_vertex, h);
    physics::Pace pace{};
    pace.target = 100;
    pace.tolerance = 1e-4;
    pace.allowed = pace.first_step = h;
    pace.largest_step = 100;
    pace.estimate_order = static_cast<std::uint32_t>(estimate_order(method));
    pace.error_before = physics::aimed_error();
    physics::forget_step(pace);
    std::uint32_t estimate[2] = {};
    const std::vector<long double> embedded[] = {method.b_hat, method.b_hat2};
    for (int k = 0; k < 2 && !embedded[k].empty(); ++k) {
      const Oscillator other = after_step(integrator, embedded[k], start_of_vertex, h);
      const long double error = std::max(std::abs(end.x - other.x) / 0.5L, std::abs(end.v - other.v) / (0.5L * omega));
      estimate[k] = std::bit_cast<std::uint32_t>(static_cast<float>(error));
    }
    pace.error = physics::joined_error(estimate[0], estimate[1]);
    physics::judge(pace, h);
    const auto device = make_cpu_device(1, 64);
    Run run(*device, start, {name, 1e-4, h});
    CHECK(run.simulation.advance_toward(h).adaptive->next_step == Approx(pace.allowed).epsilon(1e-6));
    CHECK(pace.allowed != h);
  }
}

TEST_CASE("where drag is faster than springs the error in velocity is relative to drag") {
  BodySetup setup = two_vertices();
  setup.description.stiffness = 1e-6;
  setup.description.damping = 8;
  setup.description.velocity = {1, 0, 0};
  const ModelAndState start = built(setup);
  const double rate = 8, tolerance = 1e-10;
  const auto device = make_cpu_device(1, 64);
  Run run(*device, start, {"dop853", tolerance, {}, DampingLaw::constant});
  const StepReport report = run.simulation.advance_to(2 / rate);
  const double exact = std::exp(-2.0), radius = 0.5;
  const double error = std::abs(run.simulation.state().world_velocities(start.model).front().x - exact) / (radius * rate);
  CHECK(error < 2 * tolerance);
  CHECK(report.steps < 10);  // 18 if it were relative to the springs alone
}

TEST_CASE("the way in a contact is held against the finest body's edges, whichever comes first") {
  for (const bool fine_first : {false, true}) {
    std::vector<BodySetup> bodies{sphere(fine_first ? 3 : 0), sphere(fine_first ? 0 : 3)};
    for (int b = 0; b < 2; ++b) {
      bodies[static_cast<std::size_t>(b)].description.name = b == 0 ? "left" : "right";
      bodies[static_cast<std::size_t>(b)].description.stiffness = 1e-6;
      bodies[static_cast<std::size_t>(b)].description.position = {b == 0 ? -1.02 : 1.02, 0.1, 0.05};
      bodies[static_cast<std::size_t>(b)].description.velocity = {b == 0 ? 1 : -1, 0, 0};
    }
    const ModelAndState start = build_model(bodies, glm::dvec3(0.0));
    const auto device = make_cpu_device(1, 64);
    Run run(*device, start, {"dop853", 1e-2, 0.2}, Named{"reflect"});
    StepReport before = run.simulation.report(), report = before;
    while (report.contact_steps == 0 && report.time < 0.2) report = run.simulation.advance_toward(0.2, 1);
    REQUIRE(report.contact_steps == 1);
    const double finest_edge = 0.16;  // of the sphere with 642 vertices (1.05 with 12)
    CAPTURE(fine_first, report.adaptive->smallest_step);
    CHECK(report.adaptive->smallest_step * 2 <= 0.25 * finest_edge);  // they approach by 2 m/s
    CHECK(report.adaptive->rejected_in_contact > 0);
  }
}

TEST_CASE("stages that only estimates use are taken with a tolerance alone") {
  const ModelAndState start = squashed();
  const auto device = make_cpu_device(1, 64);
  Simulation fixed(*device, start.model, start.state, plan_of({"vern8", 0.01}), with_response(Named{"none"}));
  fixed.advance(3);
  CHECK(fixed.report().force_evaluations == 3 * 12);
  Run run(*device, start, {"vern8"});
  const StepReport report = run.simulation.advance_to(0.1);
  CHECK(report.force_evaluations == 13 * (report.steps + report.adaptive->rejected));
}

TEST_CASE("a step rejected for its error or in contact changes nothing") {
  const ModelAndState start = build_model(colliding_spheres(), {0, -1, 0});
  const double huge = 0.15;  // bodies are half a metre deep in each other
  for (const TestDevice& test : all_devices())
    for (const double tolerance : {1e-6, 0.1}) {
      CAPTURE(test.name, tolerance);
      Run run(*test.device, start, {.tolerance = tolerance, .first_step = huge}, Named{"reflect"});
      const auto positions = drawn_positions(run.simulation);
      StepReport report = run.simulation.advance_toward(huge);  // as many steps as the length allowed suggests: one
      REQUIRE((report.steps == 0 && report.adaptive->rejected == 1 && report.time == 0));
      REQUIRE(report.adaptive->rejected_in_contact == (tolerance == 0.1 ? 1 : 0));
      REQUIRE(report.triangle_tests > 0);
      CHECK(same_bits(run.simulation.state(), start.state));
      CHECK((drawn_positions(run.simulation) == positions));
      CHECK((report.contact_steps == 0 && report.contact_pairs_max == 0 && report.reverted_vertices == 0 && !report.breakdown));
      // What can't be seen is as it was, too. The step that stands at last, and what follows, are as if it had come first.
      while (report.steps == 0) report = run.simulation.advance_toward(report.time + report.adaptive->next_step);
      REQUIRE(report.steps == 1);
      Run direct(*test.device, start, {.tolerance = tolerance, .first_step = report.time}, Named{"reflect"});
      CHECK(direct.simulation.advance_toward(report.time).adaptive->rejected == 0);
      CHECK(same_bits(run.simulation.state(), direct.simulation.state()));
      CHECK((drawn_positions(run.simulation) == drawn_positions(direct.simulation)));
    }
}

TEST_CASE("a rejected step that was not finite is only rejected") {
  const ModelAndState start = squashed();
  const auto device = make_cpu_device(1, 32);
  Run run(*device, start, {.first_step = 1e12});
  const StepReport first = run.simulation.advance_toward(1e12);
  CHECK((first.steps == 0 && first.adaptive->rejected == 1));
  const StepReport report = run.simulation.advance_to(1);
  CHECK_FALSE(report.breakdown);
  CHECK(report.time == 1);
}

TEST_CASE("steps end at every time asked for, bit for bit, and empty ones sum no force") {
  const ModelAndState start = squashed();
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Run run(*test.device, start, {.first_step = 1e-4});  // steps grow, so that a batch is longer than the way
    for (int frame = 1; frame <= 6; ++frame) CHECK(run.simulation.advance_to(frame / 7.0).time == frame / 7.0);
    const StepReport report = run.simulation.report();
    CHECK(report.force_evaluations + report.forces_skipped == 12 * (report.steps + report.adaptive->rejected));
    CHECK(report.adaptive->smallest_step <= 1e-4);
    CHECK(report.adaptive->largest_step > 1e-2);
    const State state = run.simulation.state();
    CHECK(run.simulation.advance_to(0.5) == report);  // in the past
    CHECK(same_bits(run.simulation.state(), state));
  }
}

TEST_CASE("a state from adaptive steps starts another run, by fixed steps or adaptive ones") {
  const ModelAndState start = squashed();
  constexpr std::uint64_t steps = 40;
  constexpr double middle = 0.3, end = 0.7;
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    // Steps grow, so that a batch is longer than the way, and its last steps are empty.
    Run run(*test.device, start, {.first_step = 1e-4});
    static_cast<void>(run.simulation.advance_to(middle));
    const ModelAndState between{start.model, run.simulation.state()};
    static_cast<void>(run.simulation.advance_to(end));
    const auto expected = run.simulation.state().world_positions(start.model);
    const State fixed = evolve(*test.device, between, {"dop853", (end - middle) / steps}, steps);
    CHECK(largest_distance(fixed.world_positions(start.model), expected) < 1e-4);
    Run again(*test.device, between, {});
    static_cast<void>(again.simulation.advance_to(end - middle));
    CHECK(largest_distance(again.simulation.state().world_positions(start.model), expected) < 1e-4);
  }
}

TEST_CASE("a body that falls freely costs one step a target, on a parabola") {
  BodySetup setup = sphere(1);
  setup.description.stiffness = 0;
  setup.description.velocity = {3, 0, 0};
  const ModelAndState start = built(setup, {0, -10, 0});
  const auto device = make_cpu_device(1, 32);
  Run run(*device, start, {.first_step = 0.1});
  const StepReport report = run.simulation.advance_to(2);
  CHECK(report.adaptive->rejected == 0);
  CHECK(report.steps < 20);
  CHECK(report.force_evaluations == 0);
  const auto from = start.state.world_positions(start.model), to = run.simulation.state().world_positions(start.model);
  CHECK(glm::length(to[0] - from[0] - glm::dvec3(6, -20, 0)) < 1e-12);
}

TEST_CASE("a run that no step can continue breaks down and names the vertex") {
  ModelAndState start = squashed();
  start.state.motion[6 * 17] = 1e300;
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Run run(*test.device, start, {});
    const StepReport report = run.simulation.advance_to(1);
    REQUIRE(report.breakdown);
    CHECK(report.breakdown->step == 1);
    CHECK(report.breakdown->body == 0);
    CHECK(report.steps == 1);
    CHECK(report.time < 1e-10);
    CHECK(report.breakdown->failed_step == report.time);
    CHECK_FALSE(report.breakdown->is_finite);
    const State state = run.simulation.state();
    CHECK(run.simulation.advance_toward(2).steps == 1);
    CHECK(same_bits(run.simulation.state(), state));
  }
}

TEST_CASE("a run whose tolerance no rounding meets ends, with a state to write and a vertex to name", "[gl][long]") {
  const ModelAndState start = squashed();
  for (const TestDevice& test : all_devices())
    for (const char* integrator : {"vern8", "dprkn12"}) {
      CAPTURE(test.name, integrator);
      TimePlan plan = plan_of(Adaptive{integrator, 1e-30}, start.model);
      plan.duration = 1e5 / stiffest_omega(start.model);
      Simulation simulation(*test.device, start.model, start.state, plan, with_response(Named{"none"}));
      const StepReport report = simulation.advance_to(plan.duration);
      REQUIRE(report.breakdown);
      CHECK(report.breakdown->failed_step > 0);
      CHECK(report.breakdown->is_finite);
      CHECK(report.steps + report.adaptive->rejected < 3000);
      CHECK_THAT(describe_breakdown(*report.breakdown, plan, start.model),
                 Catch::Contains("1e-30") && Catch::Contains("step " + std::to_string(report.steps) + " at vertex") &&
                     Catch::Contains("loosen the tolerance"));
      const State state = simulation.state();
      CHECK(largest_distance(state.world_positions(start.model), start.state.world_positions(start.model)) < 0.1);
      CHECK(simulation.advance_toward(plan.duration).steps == report.steps);
      CHECK(same_bits(simulation.state(), state));
    }
}

TEST_CASE("adaptive runs with contacts give the same bits on any number of threads") {
  const ModelAndState start = build_model(colliding_spheres(), {0, -1, 0});
  std::optional<StepReport> report;
  State state;
  for (const unsigned threads : {1u, 2u, 7u}) {
    const auto device = make_cpu_device(threads, 32);
    Run run(*device, start, {.law = DampingLaw::adaptive}, Named{"reflect"});
    const StepReport now = run.simulation.advance_to(0.3);
    CHECK(now.contact_steps > 0);
    CHECK(now.time == 0.3);
    if (report) CHECK((now == *report && same_bits(run.simulation.state(), state)));
    report = now;
    state = run.simulation.state();
  }
}

TEST_CASE("the step after one with a contact is no longer than the first") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const auto device = make_cpu_device(2, 32);
  const double first = 2e-4;
  Run run(*device, start, {.first_step = first}, Named{"reflect"});
  StepReport report = run.simulation.report();
  int long_steps_before_contacts = 0, long_steps_with_contact = 0;
  bool contact_before = false;
  while (report.time < 0.2) {
    const StepReport now = run.simulation.advance_toward(report.time + 0.99 * report.adaptive->next_step);  // one step
    const double taken = now.time - report.time;
    if (contact_before) CHECK(taken <= first);
    contact_before = now.contact_steps > report.contact_steps;
    long_steps_before_contacts += now.contact_steps == 0 && taken > 10 * first;
    long_steps_with_contact += contact_before && taken > 2 * first;
    report = now;
  }
  CHECK(long_steps_before_contacts > 1);
  CHECK(long_steps_with_contact > 1);
}

TEST_CASE("bodies that meet fast part again, however long steps were before the contact") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    std::vector<BodySetup> setups = colliding_spheres();
    setups[0].description.velocity = {16, 0, 0};
    setups[1].description.velocity = {-16, 0, 0};
    const ModelAndState start = build_model(setups, {0, 0, 0});
    Run run(*test.device, start, {.tolerance = 1e-2, .first_step = 0.02}, Named{"reflect"});
    const StepReport report = run.simulation.advance_to(0.4);
    CHECK(report.adaptive->rejected_in_contact > 0);
    CHECK(report.contact_steps > 0);
    CHECK(run.simulation.intersections().pairs == 0);
  }
}

TEST_CASE("shipped scenes of fast spheres end untangled at 60 frames a second, whatever the tolerance", "[long]") {
  const auto device = make_cpu_device(2, 32);
  for (const char* name : {"two_spheres", "three_spheres", "soft_and_hard"})
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
      CAPTURE(name, tolerance);
      SceneDescription scene = test::load_shipped_scene(name);
      scene.simulation.integrator.value = "auto";
      scene.simulation.tolerance = tolerance;
      scene.output.frame_rate = 60;
      const ModelAndState start = build_model(load_bodies(scene), scene.simulation.gravity);
      const TimePlan plan = plan_time(scene, start.model);
      Simulation simulation(*device, start.model, start.state, plan, scene.collision);
      StepReport report;
      for (std::uint64_t frame = 1; plan.time_of_frame(frame); ++frame)
        report = simulation.advance_to(*plan.time_of_frame(frame));
      CHECK(report.contact_steps > 10);
      CHECK(simulation.intersections().pairs == 0);
    }
}

TEST_CASE("triangles that touch are found whatever the latest step was") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const auto device = make_cpu_device(2, 32);
  Run run(*device, start, {.first_step = 1e-3});  // bodies pass through each other
  CHECK(run.simulation.intersections().pairs == 0);
  run.simulation.advance_to(0.4);  // empty steps fill the last batch
  CHECK(run.simulation.intersections().pairs > 0);
}

TEST_CASE("every search refits or skips every tree, also of steps that are rejected") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const auto device = make_cpu_device(2, 32);
  CollisionDescription bottom_up = with_response(Named{"reflect"});
  bottom_up.tree.refit = TreeRefit::bottom_up;
  Run run(*device, start, {}, bottom_up);
  const StepReport report = run.simulation.advance_to(0.2);
  REQUIRE(report.adaptive->rejected > 0);
  const std::uint64_t searches = report.steps + report.adaptive->rejected;
  CHECK(report.refits_skipped % 2 == 0);  // of two bodies either both are another's partner or none is
  CHECK(report.refits_skipped > 0);
  CHECK(report.refits_skipped < 2 * searches);
  CHECK(report.nodes_refitted == nodes_of_a_search(run.simulation.collider()) * (searches - report.refits_skipped / 2));
}

// A saved state in which the work groups of a body have waited in vain.
std::string with_waiting_body(std::string saved, std::size_t body) {
  const std::size_t array = saved.find("status") + std::string_view("status").size() + sizeof(std::uint64_t);
  const std::uint32_t activity = physics::halted_waiting;
  std::memcpy(saved.data() + array + body * sizeof(physics::Status), &activity, sizeof(activity));
  return saved;
}

TEST_CASE("work groups that wait in vain end any run as an error of the device") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const auto device = make_cpu_device(2, 32);
  for (std::size_t body = 0; body < start.model.bodies.size(); ++body) {
    Simulation fixed(*device, start.model, start.state, plan_of(Method{"rk4", 1e-3}), {});
    fixed.restore(with_waiting_body(fixed.save(), body));
    fixed.advance(2);
    CHECK(error_of([&] { return fixed.report(); }).kind() == ErrorKind::device);
    Run adaptive(*device, start, {});
    adaptive.simulation.restore(with_waiting_body(adaptive.simulation.save(), body));
    CHECK(error_of([&] { return adaptive.simulation.advance_to(0.1); }).kind() == ErrorKind::device);
  }
}

TEST_CASE("CPU and GPU take adaptive runs to the same place", "[gl]") {
  const ModelAndState start = squashed();
  const auto reference = make_cpu_device(1, 32);
  Run run(*reference, start, {});
  run.simulation.advance_to(1);
  const auto expected = run.simulation.state().world_positions(start.model);
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Run other(*test.device, start, {});
    other.simulation.advance_to(1);
    CHECK(largest_distance(other.simulation.state().world_positions(start.model), expected) < 1e-5);
  }
}

}  // namespace pliant
