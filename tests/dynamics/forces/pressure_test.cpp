// Closed bodies with pressure inside: shapes known in closed form, energy, and what ends a run.
#include "dynamics/forces/pressure.hpp"

#include <catch2/catch.hpp>

#include "model/deform.hpp"
#include "simulation/breakdown.hpp"
#include "simulation/measure.hpp"
#include "support/evolve.hpp"
#include "support/expect_error.hpp"

namespace pliant {
namespace {

BodySetup balloon(int level, double pressure, PressureLaw law) {
  BodySetup setup = sphere(level);
  setup.description.pressure = pressure;
  setup.description.pressure_law = law;
  return setup;
}

double sum_of_squares(const Model& model) {
  double sum = 0;
  for (const glm::vec4& rest : model.rest_positions) sum += glm::dot(glm::dvec3(rest), glm::dvec3(rest));
  return sum;
}

// The root of f between two places where it has opposite signs.
template <class F>
double root(F&& f, double low, double high) {
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    ((f(middle) < 0) == (f(low) < 0) ? low : high) = middle;
  }
  return low;
}

// The factor s by which a body of springs k grows under pressure p0, if it grows alike everywhere. For a gas
// N k (s - 1) s sum|X|^2 = 3 p0 V0. For a constant pressure N k (s - 1) sum|X|^2 = 3 p0 V0 s^2.
double expected_scale(const Model& model) {
  const ModelBody& body = model.bodies.front();
  const double springs = body.vertex_count * body.stiffness * sum_of_squares(model);
  const double push = 3 * body.inflation.pressure * body.inflation.rest_volume;
  if (body.inflation.law == PressureLaw::gas) return root([&](double s) { return springs * (s - 1) * s - push; }, 1, 10);
  return root([&](double s) { return springs * (s - 1) - push * s * s; }, 1, springs / (2 * push));
}

// The mean distance from the centroid against that at rest, after damped motion has died away.
double settled_scale(Device& device, const ModelAndState& start, std::uint64_t steps) {
  const double omega = stiffest_omega(start.model);
  const State state = evolve(device, start, {"verlet", 0.5 / omega, DampingLaw::constant}, steps);
  double now = 0, rest = 0;
  for (const glm::dvec3& position : state.world_positions(start.model)) now += glm::length(position);
  for (const glm::vec4& position : start.model.rest_positions) rest += glm::length(glm::dvec3(position));
  return now / rest;
}

TEST_CASE("a body grows until springs hold the pressure") {
  const auto device = make_cpu_device(2, 64);
  for (const PressureLaw law : {PressureLaw::gas, PressureLaw::constant})
    for (const auto& [level, pressure, damping, tolerance] :
         {std::tuple{0, 2.0, 3.0, 1e-6}, {2, 60.0, 12.0, 1e-2}, {3, 1000.0, 25.0, 1e-2}}) {
      BodySetup setup = balloon(level, pressure, law);
      setup.description.damping = damping;
      const ModelAndState start = built(setup);
      CAPTURE(static_cast<int>(law), level, expected_scale(start.model));
      CHECK(expected_scale(start.model) > 1.02);
      CHECK(settled_scale(*device, start, 4000) == Approx(expected_scale(start.model)).epsilon(tolerance));
    }
}

double drift_of(Device& device, const ModelAndState& start, double time_step, std::uint64_t steps) {
  ThreadPool pool(2);
  Simulation simulation(device, start.model, start.state, plan_of(Method{"cv8", time_step}), {.response = {"none"}});
  const Measurement first = measure(start.model, simulation.state(), glm::dvec3(0.0), pool);
  double drift = 0, scale = 0;
  for (std::uint64_t step = 0; step < steps; step += 20) {
    simulation.advance(20);
    const Measurement now = measure(start.model, simulation.state(), glm::dvec3(0.0), pool);
    drift = std::max(drift, std::abs(now.energy() - first.energy()));
    scale = std::max(scale, now.kinetic + now.elastic_size);
  }
  return drift / scale;
}

TEST_CASE("pressure keeps the energy as springs do") {
  const auto device = make_cpu_device(2, 64);
  BodySetup setup = sphere(1);
  setup.description.stretch = {0.9, 1.05, 1};
  const ModelAndState plain = built(setup);
  const double of_springs = drift_of(*device, plain, 0.5 / stiffest_omega(plain.model), 2000);
  for (const PressureLaw law : {PressureLaw::gas, PressureLaw::constant}) {
    setup.description.pressure = 5;
    setup.description.pressure_law = law;
    const ModelAndState start = built(setup);
    CAPTURE(of_springs);
    CHECK(drift_of(*device, start, 0.5 / stiffest_omega(start.model), 2000) < 2 * of_springs);
  }
}

TEST_CASE("splittings and methods with stages agree on a body with pressure") {
  BodySetup setup = balloon(1, 5, PressureLaw::gas);
  setup.description.spin = {0, 2, 1};  // so that its frame turns
  const ModelAndState start = built(setup);
  const auto device = make_cpu_device(2, 64);
  const double time_step = 0.02 / stiffest_omega(start.model);
  for (const DampingLaw law : {DampingLaw::none, DampingLaw::adaptive}) {
    const auto by_stages = evolve(*device, start, {"dop853", time_step, law}, 500).world_positions(start.model);
    const auto by_kicks = evolve(*device, start, {"verlet", time_step, law}, 500).world_positions(start.model);
    CHECK(distance(by_stages, by_kicks) < 1e-3);
    CHECK(distance(by_stages, start.state.world_positions(start.model)) > 0.1);
  }
}

TEST_CASE("the adaptive law goes by the force of springs: it damps no body that only pressure moves") {
  BodySetup setup = balloon(1, 5, PressureLaw::gas);
  setup.description.stiffness = 0;
  setup.description.damping = 100;
  const ModelAndState start = built(setup);
  const auto device = make_cpu_device(1, 64);
  for (const char* integrator : {"verlet", "cv8"}) {
    CAPTURE(integrator);
    const auto moved = [&](DampingLaw law) {
      return evolve(*device, start, {integrator, 0.01, law}, 50).world_positions(start.model);
    };
    CHECK(distance(moved(DampingLaw::adaptive), moved(DampingLaw::none)) < 1e-12);
    CHECK(distance(moved(DampingLaw::none), start.state.world_positions(start.model)) > 0.1);
  }
}

TEST_CASE("a body with pressure moves as it would alone, whatever bodies there are beside it") {
  BodySetup setups[] = {balloon(1, 5, PressureLaw::gas), sphere(0), balloon(2, 60, PressureLaw::gas)};
  for (BodySetup& setup : setups) setup.description.spin = {0.3, -1, 0.5};
  const auto device = make_cpu_device(2, 64);
  for (const Method& method : {Method{"verlet", 0.01}, {"cv8", 0.01}}) {
    CAPTURE(method.integrator);
    std::vector<double> alone;
    for (const BodySetup& setup : setups)
      for (const double number : evolve(*device, built(setup), method, 30).motion) alone.push_back(number);
    CHECK(evolve(*device, build_model(setups, glm::dvec3(0.0)), method, 30).motion == alone);
  }
}

TEST_CASE("a body turned inside out ends the run as non-finite, and is named") {
  BodySetup setups[] = {sphere(1), balloon(1, 5, PressureLaw::gas)};
  setups[0].description.position = {5, 0, 0};
  ModelAndState start = build_model(setups, glm::dvec3(0.0));
  displace(start.state, [&](std::size_t i) { return glm::dvec3(i < 42 ? 0 : -2 * start.model.rest_positions[i].x, 0, 0); });
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Simulation simulation(*test.device, start.model, start.state, plan_of(Method{"cv8", 1e-3}), {.response = {"none"}});
    simulation.advance(3);
    const auto end = simulation.report().breakdown;
    REQUIRE(end.has_value());
    CHECK((end->step == 1 && end->body == 1));
  }
}

TEST_CASE("a breakdown tells of the volume where there is pressure, and only there") {
  BodySetup setups[] = {sphere(1), balloon(1, 5, PressureLaw::gas)};
  const Model model = build_model(setups, glm::dvec3(0.0)).model;
  TimePlan plan = plan_of(Method{"cv8", 1e-3});
  plan.step_bound = 1e-2;
  const std::string fixed = describe_breakdown({.step = 1, .body = 1}, plan, model);
  CHECK_THAT(fixed, Catch::Contains("volume may have come to zero or grown without end") &&
                        Catch::Contains("shorten the time step, lower") && Catch::Contains("stiffen its springs"));
  CHECK_THAT(describe_breakdown({.step = 1, .body = 0}, plan, model), !Catch::Contains("volume"));
  plan.step_bound = 1e-4;
  CHECK_THAT(describe_breakdown({.step = 1, .body = 1}, plan, model), Catch::Contains("0.0001 s or less"));
  plan.tolerance = 1e-6;
  CHECK_THAT(describe_breakdown({.step = 1, .body = 1, .failed_step = 7.4e-17}, plan, model),
             Catch::Contains("volume may have come to zero or grown without end") && Catch::Contains("loosen the tolerance"));
}

TEST_CASE("pressure in a mesh that is open or wound inward is an error that says what to do") {
  BodySetup open = balloon(1, 5, PressureLaw::gas);
  open.mesh.triangles.pop_back();
  check_says(error_of([&] { return built(open); }), {"closed", "3 edges"});
  BodySetup turned = balloon(1, 5, PressureLaw::gas);
  std::swap(turned.mesh.triangles.front()[0], turned.mesh.triangles.front()[1]);
  check_says(error_of([&] { return built(turned); }), {"wind", "3 edges"});
  BodySetup inward = balloon(1, 5, PressureLaw::gas);
  for (auto& triangle : inward.mesh.triangles) std::swap(triangle[0], triangle[1]);
  check_says(error_of([&] { return built(inward); }), {"counter-clockwise", "turn all triangles"});
}

TEST_CASE("a body pressed below half its rest volume is told, for its bound on steps ends there") {
  BodySetup setup = balloon(1, 5, PressureLaw::gas);
  setup.description.stretch = {1, 1, 0.55};
  const ModelAndState above = built(setup);
  CHECK(pressure().warnings(above.model, above.state).empty());
  setup.description.stretch = {1, 1, 0.45};
  BodySetup setups[] = {setup, balloon(1, 5, PressureLaw::gas), setup};
  setups[2].description.name = "other";
  const ModelAndState below = build_model(setups, glm::dvec3(0.0));
  const auto warnings = pressure().warnings(below.model, below.state);
  REQUIRE(warnings.size() == 2);
  CHECK_THAT(warnings[0], Catch::Contains("\"body\"") && Catch::Contains("0.5 of its rest volume"));
  CHECK_THAT(warnings[1], Catch::Contains("\"other\""));
  setups[0].description.stretch = {1, 1, 0.4};
  const ModelAndState lower = build_model(setups, glm::dvec3(0.0));
  CHECK(pressure().warnings(lower.model, lower.state) == warnings);  // so that a run tells it once
}

TEST_CASE("a shape with enough volume in which pressure is stiffer than its bound is told") {
  for (const auto& [law, stretch] :
       {std::pair{PressureLaw::gas, glm::dvec3(2, 2, 0.13)}, {PressureLaw::constant, glm::dvec3(2.1)}}) {
    BodySetup setup = balloon(1, 5, law);
    setup.description.stretch = stretch;
    const ModelAndState start = built(setup);
    const auto warnings = pressure().warnings(start.model, start.state);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Catch::Contains("\"body\"") && Catch::Contains("stiffer") && Catch::Contains("shorter steps"));
  }
}

}  // namespace
}  // namespace pliant
