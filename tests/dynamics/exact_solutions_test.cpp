// Motions of the network that are known exactly.
#include <catch2/catch.hpp>
#include <complex>
#include <numbers>

#include "dynamics/stability.hpp"
#include "support/evolve.hpp"
#include "support/oscillator.hpp"

namespace pliant {
namespace {

using std::numbers::pi;

glm::dvec3 displacement(const State& state, std::size_t i) {
  return {state.motion[6 * i], state.motion[6 * i + 1], state.motion[6 * i + 2]};
}

glm::dvec3 velocity(const State& state, std::size_t i) {
  return {state.motion[6 * i + 3], state.motion[6 * i + 4], state.motion[6 * i + 5]};
}

glm::dvec3 mean_rest(const Model& model) {
  glm::dvec3 sum(0.0);
  for (const glm::vec4& rest : model.rest_positions) sum += glm::dvec3(rest);
  return sum / static_cast<double>(model.rest_positions.size());
}

ModelAndState breathing_sphere(double size) {
  BodySetup setup = sphere(1);
  setup.description.stretch = glm::dvec3(size);
  setup.description.stiffness = 40;
  return built(setup);
}

// One step of a Runge-Kutta method multiplies x - i v / omega of an oscillator by R(i h omega).
std::complex<double> amplification(const Integrator& integrator, double z) {
  std::complex<double> sum = 0, power = 1;
  for (const double coefficient : stability_polynomial(std::get<RungeKutta>(integrator.method))) {
    sum += coefficient * power;
    power *= std::complex<double>(0, z);
  }
  return sum;
}

// One step of a splitting kicks and drifts that oscillator.
std::complex<double> kicked_and_drifted(const Splitting& method, std::complex<double> y, double z) {
  double x = y.real(), v = -y.imag();
  for (std::size_t k = 0; k < method.kick.size(); ++k) {
    v -= static_cast<double>(method.kick[k]) * z * x;
    if (k < method.drift.size()) x += static_cast<double>(method.drift[k]) * z * v;
  }
  return {x, -v};
}

// One step of a Nystrom method sums its stages' accelerations.
std::complex<double> summed_over_stages(const Nystrom& method, std::complex<double> y, double z) {
  const Oscillator end = after_step(method, {.x = y.real(), .v = -y.imag()}, z);
  return {static_cast<double>(end.x), static_cast<double>(-end.v)};
}

std::complex<double> oscillator_after(const Integrator& integrator, double start, double z, int steps) {
  std::complex<double> y = start;
  for (int step = 0; step < steps; ++step) {
    if (const auto* splitting = std::get_if<Splitting>(&integrator.method))
      y = kicked_and_drifted(*splitting, y, z);
    else if (const auto* nystrom = std::get_if<Nystrom>(&integrator.method))
      y = summed_over_stages(*nystrom, y, z);
    else
      y *= amplification(integrator, z);
  }
  return y;
}

double breathing_error(Device& device, const Integrator& integrator, double amplitude) {
  const ModelAndState start = breathing_sphere(1 + amplitude);
  const double omega = stiffest_omega(start.model), z = 0.5;
  const State end = evolve(device, start, {integrator.name, z / omega}, 40);
  const std::complex<double> y = oscillator_after(integrator, amplitude, z, 40);
  const glm::dvec3 mean = mean_rest(start.model);
  double largest = 0;
  for (std::size_t i = 0; i < start.model.rest_positions.size(); ++i) {
    const glm::dvec3 arm = glm::dvec3(start.model.rest_positions[i]) - mean;
    largest = larger(largest, glm::length(displacement(end, i) - amplitude * mean - y.real() * arm));
    largest = larger(largest, glm::length(velocity(end, i) + omega * y.imag() * arm) / omega);
  }
  return largest / amplitude;
}

// Rounding errors of the forces reach the step's end through the weights b. Large weights of either sign amplify them.
double weight_sum(const Integrator& integrator) {
  const StagedMethod* method = staged_method(integrator);
  if (method == nullptr) return 1;
  long double sum = 0;
  for (const long double weight : method->b) sum += std::abs(weight);
  return static_cast<double>(sum);
}

TEST_CASE("a breathing body does what each method does to an oscillator", "[gl]") {
  for (const TestDevice& test : all_devices())
    for (const Integrator& integrator : integrators()) {
      CAPTURE(test.name, integrator.name);
      CHECK(breathing_error(*test.device, integrator, 0.2) < (test.rounding < 1e-12 ? 1e-12 : 1e-6) * weight_sum(integrator));
    }
}

TEST_CASE("small breathing is as exact as large, relative to its size", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    CHECK(breathing_error(*test.device, find_integrator("cv8"), 1e-4) < (test.rounding < 1e-12 ? 1e-11 : 1e-6));
  }
}

TEST_CASE("an undeformed body translates exactly and no spring is summed", "[gl]") {
  BodySetup setup = sphere(1);
  setup.description.velocity = {3, -2, 0.5};
  setup.description.position = {100, 0, 0};
  const ModelAndState start = built(setup);
  for (const TestDevice& test : all_devices())
    for (const Integrator& integrator : integrators()) {
      CAPTURE(test.name, integrator.name);
      CollisionDescription apart;
      Simulation simulation(*test.device, start.model, start.state, plan_of({integrator.name, 0.01}), apart);
      simulation.advance(50);
      const State end = simulation.state();
      for (std::size_t i = 0; i < start.model.rest_positions.size(); ++i)
        CHECK(glm::length(displacement(end, i) - 0.5 * glm::dvec3(3, -2, 0.5)) < 1e-13);
      CHECK(simulation.report().force_evaluations == 0);
      CHECK(simulation.report().forces_skipped >= 50);
    }
}

TEST_CASE("a freely falling body follows its parabola", "[gl]") {
  const ModelAndState start = built(sphere(1), {0, -9.81, 0});
  for (const TestDevice& test : all_devices())
    for (const Integrator& integrator : integrators()) {
      CAPTURE(test.name, integrator.name);
      const State end = evolve(*test.device, start, {integrator.name, 0.01}, 100);
      for (std::size_t i = 0; i < start.model.rest_positions.size(); ++i)
        CHECK(glm::length(displacement(end, i) - glm::dvec3(0, -0.5 * 9.81, 0)) < 1e-12);
    }
}

TEST_CASE("constant damping stops a drifting body as exp(-c t / m)", "[gl]") {
  BodySetup setup = sphere(0);
  setup.description.velocity = {2, 0, 0};
  setup.description.damping = 3;
  setup.description.vertex_mass = 2;
  const ModelAndState start = built(setup);
  for (const TestDevice& test : all_devices())
    for (const char* name : {"verlet", "cv8", "dop853"}) {
      CAPTURE(test.name, name);
      const State end = evolve(*test.device, start, {name, 0.01, DampingLaw::constant}, 100);
      CHECK(velocity(end, 0).x == Approx(2 * std::exp(-1.5)).epsilon(1e-13));
    }
}

TEST_CASE("verlet's damped kick stays exact where c is enormous") {
  BodySetup setup = sphere(0);
  setup.description.velocity = {2, 0, 0};
  setup.description.damping = 1e6;
  const ModelAndState start = built(setup);
  const auto device = make_cpu_device(1, 64);
  const State end = evolve(*device, start, {"verlet", 0.01, DampingLaw::constant}, 100);
  CHECK(std::abs(velocity(end, 0).x) < 1e-300);
  CHECK(displacement(end, 0).x == Approx(0).margin(1e-300));
}

TEST_CASE("two vertices oscillate about the rest length of their spring", "[gl]") {
  BodySetup setup = two_vertices();
  setup.description.stretch = {1.3, 1, 1};
  const ModelAndState start = built(setup);
  const double omega = std::sqrt(2.0);
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    const State end = evolve(*test.device, start, {"cv8", 0.02 / omega}, 250);  // omega t = 5
    const double separation = 1 + displacement(end, 1).x - displacement(end, 0).x;
    CHECK(separation == Approx(1 + 0.3 * std::cos(5.0)).margin(test.rounding < 1e-12 ? 1e-12 : 3e-7));
    CHECK(velocity(end, 1).x == Approx(-0.15 * omega * std::sin(5.0)).margin(test.rounding < 1e-12 ? 1e-12 : 3e-7));
  }
}

// At length l and turning rate W the spring holds the circle: k (l - 1) = m W^2 l / 2.
TEST_CASE("two vertices circle each other on the orbit that their spring holds", "[gl]") {
  const double rate = 0.5, length = 1 / (1 - rate * rate / 2);
  BodySetup setup = two_vertices();
  setup.description.stretch = {length, 1, 1};
  setup.description.spin = {0, 0, rate};
  const ModelAndState start = built(setup);
  const int steps = 1000;
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    const State end = evolve(*test.device, start, {"cv8", 5 * 2 * pi / rate / steps}, steps);  // five turns
    const auto positions = end.world_positions(start.model);
    CHECK(distance(positions, start.state.world_positions(start.model)) < (test.rounding < 1e-12 ? 1e-9 : 2e-5));
  }
}

}  // namespace
}  // namespace pliant
