// Conservation, symmetry and convergence of the integrators on a body in general motion.
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "core/thread_pool.hpp"
#include "simulation/measure.hpp"
#include "support/evolve.hpp"

namespace pliant {
namespace {

// A lopsided cloud of 12 vertices, squashed and spinning.
BodySetup tumbling() {
  std::mt19937 random(20240501);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  TriangleMesh mesh;
  for (int i = 0; i < 12; ++i) mesh.positions.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  BodySetup setup = body_of_mesh(mesh);
  setup.description.stretch = {1.2, 0.85, 1.05};
  setup.description.spin = {0.3, -0.2, 0.5};
  setup.description.velocity = {1, 2, -0.5};
  return setup;
}

Measurement measured(const Model& model, const State& state, const glm::dvec3& gravity = glm::dvec3(0.0)) {
  ThreadPool pool(1);
  return measure(model, state, gravity, pool);
}

double error_at(Device& device, const ModelAndState& start, const Method& method, double end_time,
                const std::vector<glm::dvec3>& exact) {
  const auto steps = static_cast<std::uint64_t>(std::lround(end_time / method.time_step));
  return distance(evolve(device, start, method, steps).world_positions(start.model), exact);
}

std::vector<glm::dvec3> reference(const ModelAndState& start, DampingLaw law, double time_step, std::uint64_t steps) {
  return evolve(*make_cpu_device(1, 64), start, {"vern8", time_step, law}, steps).world_positions(start.model);
}

// How fast the error shrinks with the step: minus the slope of log2(error) over the halvings, by least squares.
double measured_order(const ModelAndState& start, const Method& coarse, double end_time, int halvings,
                      const std::vector<glm::dvec3>& exact) {
  const auto device = make_cpu_device(1, 64);
  const double middle = halvings / 2.0;
  double covariance = 0, variance = 0;
  for (int k = 0; k <= halvings; ++k) {
    const double error =
        error_at(*device, start, {coarse.integrator, std::ldexp(coarse.time_step, -k), coarse.law}, end_time, exact);
    CHECK(error > 1e-12);  // far above rounding, so that the slope means something
    covariance -= (k - middle) * std::log2(error);
    variance += (k - middle) * (k - middle);
  }
  return covariance / variance;
}

// Where the order of a method can be measured. Steps are so short that the first term of the error leads. They are so many that
// the error is far above rounding, which is 1e-14 to 3e-14.
struct OrderRange {
  double omega_step, margin;
  int steps;
};

OrderRange range_of(int order) {
  if (order > 8) return {3.2, 0.45, 16};     // 11.6 to 11.9 are measured
  if (order == 8) return {0.8, 0.2, 24};     // 7.86 to 8.04
  return {order >= 6 ? 0.6 : 0.1, 0.1, 16};  // within 0.03
}

TEST_CASE("halving the step shrinks the error as the method's order says") {
  BodySetup setup = tumbling();
  setup.description.damping = 0.1;  // with more the motion dies away, and its error with it, before the error is large enough
  const ModelAndState start = built(setup);
  for (const DampingLaw law : {DampingLaw::none, DampingLaw::constant, DampingLaw::internal})
    for (const Integrator& integrator : integrators()) {
      if (!allows_damping(integrator, law)) continue;
      CAPTURE(integrator.name, static_cast<int>(law));
      const OrderRange range = range_of(integrator.order);
      const double step = range.omega_step / stiffest_omega(start.model), end_time = range.steps * step;
      const auto exact = reference(start, law, step / 32, static_cast<std::uint64_t>(range.steps) * 32);
      CHECK(measured_order(start, {integrator.name, step, law}, end_time, 1, exact) ==
            Approx(integrator.order).margin(range.margin));
    }
}

TEST_CASE("the kinks of the adaptive law leave any method order two", "[long]") {
  BodySetup setup = sphere(1);
  setup.description.stretch = {1.2, 0.85, 1};
  setup.description.stiffness = 100;  // forces on both sides of the kink at 100 N
  const ModelAndState start = built(setup);
  const double step = 0.4 / stiffest_omega(start.model), end_time = 40 * step;
  const auto exact = reference(start, DampingLaw::adaptive, step / 512, 40 * 512);
  for (const Integrator& integrator : integrators()) {
    if (!allows_damping(integrator, DampingLaw::adaptive)) continue;
    CAPTURE(integrator.name);
    // Where in a step a vertex meets the kink differs from step to step, so errors scatter about their slope. It is 2.01 to 2.10.
    CHECK(measured_order(start, {integrator.name, step, DampingLaw::adaptive}, end_time, 5, exact) == Approx(2).margin(0.3));
  }
}

TEST_CASE("bodies of different damping each move as they would alone", "[gl]") {
  BodySetup still = sphere(0), thick = sphere(1);
  still.description.damping = 0;
  still.description.stretch = thick.description.stretch = {1.2, 0.9, 1};
  thick.description.damping = 4;
  thick.description.velocity = {0.5, 0, 0};
  const BodySetup both[] = {still, thick};
  const ModelAndState together = build_model(both, glm::dvec3(0.0)), alone[] = {built(still), built(thick)};
  for (const TestDevice& test : all_devices())
    for (const char* name : {"dprkn8", "dprkn12", "cv8"}) {
      CAPTURE(test.name, name);
      const Method method{name, 0.1, DampingLaw::constant};
      const State pair = evolve(*test.device, together, method, 20);
      std::vector<double> joined;
      for (const ModelAndState& start : alone)
        std::ranges::copy(evolve(*test.device, start, method, 20).motion, std::back_inserter(joined));
      CHECK(pair.motion == joined);
    }
}

// The same motion of a body with pressure.
BodySetup tumbling_balloon() {
  BodySetup setup = sphere(1);
  setup.description = tumbling().description;
  setup.description.pressure = 5;
  return setup;
}

void check_momentum(const ModelAndState& start) {
  const Measurement before = measured(start.model, start.state);
  for (const TestDevice& test : all_devices())
    for (const Integrator& integrator : integrators()) {
      CAPTURE(test.name, integrator.name);
      const double step = (integrator.order >= 8 ? 0.2 : 0.02) / stiffest_omega(start.model);
      const Measurement after = measured(start.model, evolve(*test.device, start, {integrator.name, step}, 200));
      const double tolerance = test.rounding < 1e-12 ? 1e-11 : 2e-5;
      CHECK(glm::distance(after.momentum, before.momentum) < tolerance * glm::length(before.momentum));
      // A Runge-Kutta method turns rigidly only to its own order. A splitting does so exactly.
      CHECK(glm::distance(after.angular_momentum, before.angular_momentum) <
            std::max(tolerance, integrator.order == 4 ? 1e-7 : 1e-9) * glm::length(before.angular_momentum));
    }
}

TEST_CASE("momentum and angular momentum are conserved without damping", "[gl]") { check_momentum(built(tumbling())); }

TEST_CASE("pressure conserves momentum and angular momentum by every method", "[gl][long]") {
  check_momentum(built(tumbling_balloon()));
}

TEST_CASE("without damping the energy error of an order-8 method falls with its ninth power") {
  const ModelAndState start = built(tumbling());
  const double energy = measured(start.model, start.state).energy();
  const auto device = make_cpu_device(1, 64);
  const auto drift = [&](double z, std::uint64_t steps) {
    const State end = evolve(*device, start, {"cv8", z / stiffest_omega(start.model)}, steps);
    return std::abs(measured(start.model, end).energy() / energy - 1);
  };
  const double coarse = drift(1.0, 100), fine = drift(0.5, 200);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-2);
  CHECK(std::log2(coarse / fine) == Approx(9).margin(1.0));
}

TEST_CASE("damping takes energy away, and never gives any", "[gl]") {
  const ModelAndState start = built(tumbling());
  for (const TestDevice& test : all_devices())
    for (const DampingLaw law : {DampingLaw::constant, DampingLaw::adaptive, DampingLaw::internal}) {
      CAPTURE(test.name, static_cast<int>(law));
      double energy = measured(start.model, start.state).energy();
      State state = start.state;
      for (int part = 0; part < 10; ++part) {
        state = evolve(*test.device, {start.model, state}, {"verlet", 0.2 / stiffest_omega(start.model), law}, 5);
        const double later = measured(start.model, state).energy();
        CHECK(later < energy);
        energy = later;
      }
    }
}

TEST_CASE("a body pressed flat, to a point or inside out springs back with bounded forces", "[gl]") {
  for (const glm::dvec3& stretch : {glm::dvec3(0, 1, 1), glm::dvec3(1e-4, 1, 1), glm::dvec3(3e-4), glm::dvec3(-0.5, 1, 1)}) {
    BodySetup setup = sphere(1);
    setup.description.stretch = stretch;
    const ModelAndState start = built(setup);
    const double before = measured(start.model, start.state).energy();
    for (const TestDevice& test : all_devices()) {
      CAPTURE(test.name, stretch.x, stretch.y);
      const State end = evolve(*test.device, start, {"dop853", 0.05 / stiffest_omega(start.model), DampingLaw::constant}, 40);
      const double after = measured(start.model, end).energy();
      CHECK(after >= 0);
      // In bodies pressed exactly flat vertices coincide. These pairs exert no force and count no energy until they part.
      CHECK(after < (stretch.x == 0 ? 1.2 : 1.001) * before);
    }
  }
}

TEST_CASE("energy with gravity is conserved") {
  const glm::dvec3 gravity(0.5, -9.81, 0);
  const ModelAndState start = built(tumbling(), gravity);
  const auto device = make_cpu_device(1, 64);
  const double before = measured(start.model, start.state, gravity).energy();
  const State end = evolve(*device, start, {"cv8", 0.1 / stiffest_omega(start.model)}, 300);
  CHECK(measured(start.model, end, gravity).energy() == Approx(before).epsilon(1e-10));
}

// How far the tumbling body, turned by a scene's rotation [degrees] and moved, ends from the turned and moved result.
double invariance_error(Device& device, const glm::dvec3& rotation, const glm::dvec3& position) {
  const glm::dvec3 angle = glm::radians(rotation);
  const glm::dmat3 turn =
      glm::mat3_cast(glm::angleAxis(angle.z, glm::dvec3(0, 0, 1)) * glm::angleAxis(angle.y, glm::dvec3(0, 1, 0)) *
                     glm::angleAxis(angle.x, glm::dvec3(1, 0, 0)));
  BodySetup moved = tumbling();
  moved.description.rotation = rotation;
  moved.description.position = position;
  moved.description.spin = turn * moved.description.spin;
  moved.description.velocity = turn * moved.description.velocity;
  const ModelAndState here = built(tumbling()), there = built(moved);
  const Method method{"cv8", 0.3 / stiffest_omega(here.model), DampingLaw::adaptive};
  std::vector<glm::dvec3> expected;
  for (const glm::dvec3& p : evolve(device, here, method, 100).world_positions(here.model))
    expected.push_back(turn * p + position);
  return distance(evolve(device, there, method, 100).world_positions(there.model), expected);
}

// Frames turn with the body, so even forces in fp32 hardly notice a rotation.
TEST_CASE("a turned start gives the turned result", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    CHECK(invariance_error(*test.device, {30, -50, 110}, {0, 0, 0}) < (test.rounding < 1e-12 ? 1e-12 : 1e-8));
  }
}

// At 1e4 m an fp64 position loses 1e-12. For that an fp32 force next to the middle of two numbers may round the other way. The
// trajectory carries it on: 1e-9 on a CPU, 4e-8 on an H200. Positions rounded to fp32 there would show 6e-4.
TEST_CASE("a moved start gives the moved result, with no loss of fp32 digits far from the origin", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    CHECK(invariance_error(*test.device, {0, 0, 0}, {1e4, -3e3, 500}) < (test.rounding < 1e-12 ? 1e-10 : 3e-7));
  }
}

TEST_CASE("fp32 forces with fp64 state keep to the fp64 trajectory", "[gl]") {
  BodySetup setup = sphere(2);
  setup.description.stretch = {1.1, 0.95, 1};
  const ModelAndState start = built(setup);
  const Method method{"cv8", 0.5 / stiffest_omega(start.model)};
  const auto exact = evolve(*make_cpu_device(2, 64), start, method, 200);
  double size = 0;
  for (const double number : start.state.motion) size += number * number;
  for (const TestDevice& test : all_devices()) {
    if (test.rounding < 1e-12) continue;
    CAPTURE(test.name);
    const State end = evolve(*test.device, start, method, 200);
    CHECK(distance(end.world_positions(start.model), exact.world_positions(start.model)) < 1e-6 * std::sqrt(size));
  }
}

TEST_CASE("changing a body's frame leaves its motion as it was", "[gl]") {
  BodySetup setup = tumbling();
  setup.description.spin = {2, -1, 3};  // many changes of frame
  const ModelAndState start = built(setup);
  const Measurement before = measured(start.model, start.state);
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    CollisionDescription apart;
    const double step = 0.1 / stiffest_omega(start.model);
    Simulation simulation(*test.device, start.model, start.state, plan_of({"cv8", step}), apart);
    simulation.advance(600);
    CHECK(simulation.report().frame_changes > 100);
    const Measurement after = measured(start.model, simulation.state());
    const double tolerance = test.rounding < 1e-12 ? 1e-9 : 3e-5;
    CHECK(after.energy() == Approx(before.energy()).epsilon(tolerance));
    CHECK(glm::distance(after.angular_momentum, before.angular_momentum) < tolerance * glm::length(before.angular_momentum));
  }
}

}  // namespace
}  // namespace pliant
