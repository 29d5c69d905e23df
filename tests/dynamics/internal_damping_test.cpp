// Internal damping takes vibrations away. It leaves alone how bodies fly, fall and turn.
#include <catch2/catch.hpp>
#include <complex>
#include <glm/geometric.hpp>
#include <random>

#include "core/thread_pool.hpp"
#include "simulation/measure.hpp"
#include "support/collision_scene.hpp"
#include "support/evolve.hpp"

namespace pliant {
namespace {

using Complex = std::complex<double>;

constexpr DampingLaw internal = DampingLaw::internal;

std::vector<const Integrator*> damping_integrators() {
  std::vector<const Integrator*> all;
  for (const Integrator& integrator : integrators())
    if (allows_damping(integrator, internal)) all.push_back(&integrator);
  return all;
}

Measurement measurement_of(const Model& model, const State& state, const glm::dvec3& gravity = glm::dvec3(0.0)) {
  ThreadPool pool(1);
  return measure(model, state, gravity, pool);
}

// A lopsided cloud of vertices, deformed, flying and spinning.
BodySetup cloud(int vertices = 12) {
  std::mt19937 random(20240501);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  TriangleMesh mesh;
  for (int i = 0; i < vertices; ++i) mesh.positions.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  BodySetup setup = body_of_mesh(mesh);
  setup.description.stretch = {1.2, 0.85, 1.05};
  setup.description.spin = {0.3, -0.2, 0.5};
  setup.description.velocity = {1, 2, -0.5};
  return setup;
}

BodySetup line(const glm::dvec3& along, int vertices) {
  TriangleMesh mesh;
  for (int i = 0; i < vertices; ++i) mesh.positions.emplace_back(static_cast<double>(i) * along);
  BodySetup setup = body_of_mesh(mesh);
  setup.description.stretch = glm::dvec3(1.2);
  setup.description.spin = {0.3, -0.2, 0.5};
  setup.description.velocity = {1, 2, -0.5};
  return setup;
}

// The largest speed at which two vertices of the first body come closer or part [m/s].
double deformation_speed(const Model& model, const State& state) {
  const auto places = state.world_positions(model), velocities = state.world_velocities(model);
  double most = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      most = larger(most, std::abs(glm::dot(glm::normalize(places[i] - places[j]), velocities[i] - velocities[j])));
  return most;
}

void check_momentum(const ModelAndState& start, int steps) {
  const Measurement before = measurement_of(start.model, start.state);
  for (const TestDevice& test : all_devices())
    for (const Integrator* integrator : damping_integrators()) {
      CAPTURE(test.name, integrator->name, start.model.vertex_count());
      const double step = (integrator->order >= 8 ? 0.2 : 0.02) / stiffest_omega(start.model);
      const Measurement after = measurement_of(
          start.model, evolve(*test.device, start, {integrator->name, step, internal}, static_cast<std::uint64_t>(steps)));
      CHECK(after.energy() < before.energy());
      const double tolerance = test.rounding < 1e-12 ? 1e-11 : 2e-5;
      CHECK(glm::distance(after.momentum, before.momentum) <
            (test.rounding < 1e-12 ? 1e-12 : 2e-5) * glm::length(before.momentum));
      // A Runge-Kutta method turns rigidly only to its own order. A splitting does so exactly.
      CHECK(glm::distance(after.angular_momentum, before.angular_momentum) <
            std::max(tolerance, integrator->order == 4 ? 1e-7 : 1e-9) * glm::length(before.angular_momentum));
    }
}

TEST_CASE("internal damping conserves momentum and angular momentum", "[gl]") {
  check_momentum(built(cloud()), 200);
  check_momentum(built(cloud(70)), 50);  // several parts
}

TEST_CASE("internal damping conserves them of a body under pressure, too", "[gl][long]") {
  BodySetup setup = sphere(1);
  setup.description = cloud().description;
  setup.description.pressure = 5;
  check_momentum(built(setup), 200);
}

TEST_CASE("internal damping conserves them of bodies that are lines", "[gl]") {
  for (const int vertices : {2, 9}) check_momentum(built(line({0.1, 0.17, -0.23}, vertices)), 100);
}

// A body that turns about none of its principal axes is deformed by that for long. A sphere has only principal axes.
TEST_CASE("internal damping leaves a sphere that turns steadily", "[gl]") {
  BodySetup setup = sphere(0);
  setup.description = cloud().description;
  const ModelAndState start = built(setup);
  const double step = 0.4 / stiffest_omega(start.model);
  for (const TestDevice& test : all_devices())
    for (const char* name : {"verlet", "cv8"}) {
      CAPTURE(test.name, name);
      const Method method{name, step, internal};
      const State late = evolve(*test.device, start, method, 600);  // 69 s, and c / m is 1 / s
      const double early = deformation_speed(start.model, evolve(*test.device, start, method, 5));
      CHECK(early > 0.1);
      CHECK(deformation_speed(start.model, late) <
            (method.integrator == "cv8" ? 1e-4 : 1e-2) * early);  // verlet's circles are polygons
      const Measurement before = measurement_of(start.model, start.state), after = measurement_of(start.model, late);
      CHECK(glm::distance(after.angular_momentum, before.angular_momentum) <
            (test.rounding < 1e-12 ? 1e-6 : 1e-4) * glm::length(before.angular_momentum));
    }
}

// A breathing body is an oscillator s'' = -omega^2 s - g s', also while it flies. A step of a Runge-Kutta method multiplies each
// of its two motions e^(lambda t) by R(h lambda).
struct Breath {
  double size, rate;  // s, s'
};

Complex amplification(const RungeKutta& method, Complex z) {
  Complex sum = 0, power = 1;
  for (const double coefficient : stability_polynomial(method)) {
    sum += coefficient * power;
    power *= z;
  }
  return sum;
}

Breath after_steps(const RungeKutta& method, double amplitude, double omega, double g, double h, int steps) {
  const Complex lambda(-g / 2, std::sqrt(omega * omega - g * g / 4)), from = amplitude * Complex(1, -g / (2 * lambda.imag()));
  const Complex end = from * std::pow(amplification(method, h * lambda), steps);
  return {end.real(), (lambda * end).real()};
}

Breath after_steps(const Splitting& method, double amplitude, double omega, double g, double h, int steps) {
  Breath b{amplitude, 0};
  for (int step = 0; step < steps; ++step)
    for (std::size_t k = 0; k < method.kick.size(); ++k) {
      const double t = static_cast<double>(method.kick[k]) * h;
      b.rate = std::exp(-g * t) * b.rate + std::expm1(-g * t) / g * omega * omega * b.size;
      if (k < method.drift.size()) b.size += static_cast<double>(method.drift[k]) * h * b.rate;
    }
  return b;
}

double damped_breathing_error(Device& device, const Integrator& integrator) {
  const double amplitude = 0.2;
  BodySetup setup = sphere(1);
  setup.description.stretch = glm::dvec3(1 + amplitude);
  setup.description.stiffness = 40;
  setup.description.damping = 9;
  setup.description.velocity = {3, -2, 0.5};
  const ModelAndState start = built(setup);
  const int steps = 40;
  const double omega = stiffest_omega(start.model), h = 0.5 / omega, g = 9;
  const State end = evolve(device, start, {integrator.name, h, internal}, steps);
  const Breath b = std::holds_alternative<Splitting>(integrator.method)
                       ? after_steps(std::get<Splitting>(integrator.method), amplitude, omega, g, h, steps)
                       : after_steps(std::get<RungeKutta>(integrator.method), amplitude, omega, g, h, steps);
  const auto velocities = end.world_velocities(start.model);
  double largest = 0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const glm::dvec3 arm = start.model.rest_position(i), way = (steps * h) * setup.description.velocity;
    largest = larger(largest, glm::length(end.displacement(i) - way - b.size * arm));
    largest = larger(largest, glm::length(velocities[i] - setup.description.velocity - b.rate * arm) / omega);
  }
  return largest / amplitude;
}

TEST_CASE("a breathing body in flight does what each method does to a damped oscillator", "[gl]") {
  for (const TestDevice& test : all_devices())
    for (const Integrator* integrator : damping_integrators()) {
      CAPTURE(test.name, integrator->name);
      const double weights = integrator->name == "vern8" || integrator->name == "cv8" ? 100 : 10;
      CHECK(damped_breathing_error(*test.device, *integrator) < (test.rounding < 1e-12 ? 1e-12 : 1e-6) * weights);
    }
}

TEST_CASE("an undeformed body falls as without damping, and no spring is summed", "[gl]") {
  BodySetup setup = sphere(1);
  setup.description.velocity = {3, -2, 0.5};
  setup.description.damping = 50;
  const ModelAndState start = built(setup, {0, -9.81, 1});
  for (const TestDevice& test : all_devices())
    for (const Integrator* integrator : damping_integrators()) {
      CAPTURE(test.name, integrator->name);
      CollisionDescription apart;
      Simulation simulation(*test.device, start.model, start.state, plan_of(Method{integrator->name, 0.01, internal}), apart);
      simulation.advance(50);
      CHECK(simulation.report().force_evaluations == 0);
      const State end = simulation.state();
      for (std::size_t i = 0; i < start.model.vertex_count(); ++i)
        CHECK(glm::length(end.displacement(i) - glm::dvec3(1.5, -1 - 0.125 * 9.81, 0.25 + 0.125)) < 1e-12);
    }
}

TEST_CASE("a vibrating body's centre falls on its parabola", "[gl]") {
  const glm::dvec3 gravity(0, -9.81, 1);
  const ModelAndState start = built(cloud(), gravity);
  const Measurement before = measurement_of(start.model, start.state);
  const double mass = 12, h = 0.1 / stiffest_omega(start.model);
  for (const TestDevice& test : all_devices())
    for (const Integrator* integrator : damping_integrators()) {
      CAPTURE(test.name, integrator->name);
      const State end = evolve(*test.device, start, {integrator->name, h, internal}, 100);
      const glm::dvec3 expected = before.momentum + (100 * h * mass) * gravity;
      CHECK(glm::distance(measurement_of(start.model, end).momentum, expected) < (test.rounding < 1e-12 ? 1e-11 : 1e-4));
    }
}

// At length l and turning rate W the spring holds the circle: k (l - 1) = m W^2 l / 2.
TEST_CASE("strong internal damping lets two vertices circle each other on the orbit that their spring holds", "[gl]") {
  const double rate = 0.5, length = 1 / (1 - rate * rate / 2);
  BodySetup setup = two_vertices();
  setup.description.stretch = {length, 1, 1};
  setup.description.spin = {0, 0, rate};
  setup.description.damping = 5;
  const ModelAndState start = built(setup);
  const int steps = 1000;
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    const State end =
        evolve(*test.device, start, {"cv8", 5 * 2 * 3.14159265358979323846 / rate / steps, internal}, steps);  // five turns
    CHECK(distance(end.world_positions(start.model), start.state.world_positions(start.model)) <
          (test.rounding < 1e-12 ? 1e-9 : 2e-5));
  }
}

TEST_CASE("a body of one vertex flies on under internal damping", "[gl]") {
  BodySetup setup = body_of_mesh({{{0, 0, 0}}, {}});
  setup.description.velocity = {1, 2, 3};
  const ModelAndState start = built(setup);
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    const State end = evolve(*test.device, start, {"verlet", 0.1, internal}, 10);
    CHECK(glm::distance(end.displacement(0), glm::dvec3(1, 2, 3)) < 1e-14);
  }
}

TEST_CASE("bodies beside each other are damped as they would be alone, and one without damping is not", "[gl]") {
  BodySetup still = cloud(), thick = sphere(1);
  still.description.damping = 0;
  thick.description.stretch = {1.2, 0.9, 1};
  thick.description.damping = 4;
  const BodySetup both[] = {still, thick};
  const ModelAndState together = build_model(both, glm::dvec3(0.0)), alone[] = {built(still), built(thick)};
  for (const TestDevice& test : all_devices())
    for (const char* name : {"verlet", "cv8"}) {
      CAPTURE(test.name, name);
      std::vector<double> joined;
      for (const auto& [start, law] : {std::pair(&alone[0], DampingLaw::none), std::pair(&alone[1], internal)})
        std::ranges::copy(evolve(*test.device, *start, {name, 0.05, law}, 20).motion, std::back_inserter(joined));
      const State pair = evolve(*test.device, together, {name, 0.05, internal}, 20);
      double largest = 0;
      for (std::size_t n = 0; n < joined.size(); ++n) largest = larger(largest, std::abs(pair.motion[n] - joined[n]));
      CHECK(largest < 1e-13);
    }
}

// At such steps Runge-Kutta methods turn a fast body faster and faster, with internal damping or none.
TEST_CASE("a squashed sphere that spins slowly calms down at automatic steps, whatever its internal damping") {
  const auto device = make_cpu_device(1, 64);
  for (const Integrator* integrator : damping_integrators())
    for (const double rate : {0.03, 0.3, 1.0, 2.0, 10.0}) {  // over omega
      CAPTURE(integrator->name, rate);
      BodySetup setup = sphere(0);
      setup.description.stretch = {0.5, 1.4, 1.4};
      setup.description.spin = {0.03, -0.02, 0.05};
      setup.description.damping = rate * stiffest_omega(built(setup).model);
      const ModelAndState start = built(setup);
      const double step = 0.9 * integrator->strained_bound * step_bound(*integrator, start.model.bodies.front(), internal);
      const double before = measurement_of(start.model, start.state).energy();
      for (const std::uint64_t steps : {100, 500}) {
        const State later = evolve(*device, start, {integrator->name, step, internal}, steps);
        CHECK(measurement_of(start.model, later).energy() < (steps == 500 && rate < 1 ? 0.1 : 1.0) * before);  // else it creeps
      }
    }
}

TEST_CASE("a tolerance governs steps with internal damping") {
  const ModelAndState start = built(cloud());
  const auto device = make_cpu_device(2, 64);
  const double time = 20 / stiffest_omega(start.model);
  const auto exact = evolve(*device, start, {"vern8", time / 1000, internal}, 1000).world_positions(start.model);
  double before = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    CAPTURE(tolerance);
    CollisionDescription apart;
    Simulation simulation(*device, start.model, start.state, plan_of(Adaptive{"dop853", tolerance, {}, internal}, start.model),
                          apart);
    simulation.advance_to(time);
    const double error = distance(simulation.state().world_positions(start.model), exact);
    CHECK(error < 100 * tolerance);
    CHECK(error < before / 10);
    before = error;
  }
}

// Steps fall into parts while the bodies touch, and so do kicks.
TEST_CASE("spheres that meet by impulses and fall with internal damping have the momentum that gravity gives", "[gl]") {
  const glm::dvec3 gravity(0, -9.81, 1);
  std::vector<BodySetup> setups = colliding_spheres();
  for (BodySetup& setup : setups) setup.description.damping = 20;
  const ModelAndState start = build_model(setups, gravity);
  const Measurement before = measurement_of(start.model, start.state);
  const double mass = start.model.vertex_count(), h = 0.03;
  for (const TestDevice& test : all_devices())
    for (const char* name : {"verlet", "cv8"}) {
      CAPTURE(test.name, name);
      Simulation simulation(*test.device, start.model, start.state, plan_of(Method{name, h, internal}),
                            {.response = {"impulse"}});
      simulation.advance(40);
      const StepReport report = simulation.report();
      REQUIRE((report.contact_steps > 0 && report.substeps > 0));
      const glm::dvec3 expected = before.momentum + (report.time * mass) * gravity;
      CHECK(glm::distance(measurement_of(start.model, simulation.state()).momentum, expected) <
            (test.rounding < 1e-12 ? 1e-11 : 1e-6) * glm::length(expected));
    }
}

}  // namespace
}  // namespace pliant
