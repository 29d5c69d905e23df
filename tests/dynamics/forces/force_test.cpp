// What every force of the list promises. The tests' own force is a row like the others.
#include "dynamics/forces/force.hpp"

#include <catch2/catch.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <random>

#include "dynamics/stepper.hpp"
#include "support/evolve.hpp"
#include "support/own_rows.hpp"

namespace pliant {
namespace {

// A sphere on which this force acts alone. Springs act on every body, but their stiffness can be zero.
BodySetup setup_of(const ForceExample& example) {
  BodySetup setup = sphere(1);
  setup.description.stiffness = 0;
  example.set(setup.description);
  return setup;
}

struct Example {
  std::string_view name;
  const Force* row;
  ModelAndState start;
};

std::vector<Example> examples() {
  add_own_rows();
  std::vector<Example> all;
  for (const Force& force : forces()) {
    const std::size_t before = all.size();
    for (const ForceExample& example : force_examples())
      if (example.force == force.name) all.push_back({example.name, &force, built(setup_of(example))});
    if (all.size() == before)
      FAIL("the force \"" << force.name << "\" has no example: add one to force_examples() in tests/support/own_rows.cpp");
  }
  for (const Example& example : all) REQUIRE(feels(example.start.model.bodies.front(), *example.row));
  return all;
}

State deformed(const ModelAndState& start, double size) {
  State state = start.state;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> change(-size, size);
  for (std::size_t i = 0; i < start.model.vertex_count(); ++i)
    for (std::size_t k = 0; k < 3; ++k) state.motion[6 * i + k] += change(random);
  return state;
}

// All of a body's forces at a state, by a method's first stage.
std::vector<glm::dvec3> forces_at(Device& device, const Model& model, const State& state) {
  DeviceBodies bodies(device, model, state);
  const Stepper stepper(bodies, model, find_integrator("rk4"), DampingLaw::none, 1e-3);
  device.run(stepper.first_passes());
  device.run(stepper.passes(0));
  const std::vector<double> a = bodies.arrays.get<double>("acceleration").download();
  std::vector<glm::dvec3> forces;
  for (std::size_t i = 0; i < model.vertex_count(); ++i)
    forces.push_back(model.body_of(i).vertex_mass * glm::dvec3(a[3 * i], a[3 * i + 1], a[3 * i + 2]));
  return forces;
}

glm::dvec3 position(const Model& model, const State& state, std::size_t i) {
  return glm::dvec3(model.rest_positions[i]) + glm::dvec3(state.motion[6 * i], state.motion[6 * i + 1], state.motion[6 * i + 2]);
}

double size_of(const std::vector<glm::dvec3>& forces) {
  double sum = 0;
  for (const glm::dvec3& force : forces) sum += glm::length(force);
  return sum;
}

double largest_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = larger(largest, glm::length(a[i] - b[i]));
  return largest;
}

double energy_of(const Force& force, const Model& model, const State& state) {
  ThreadPool pool(1);
  std::any kept;
  return force.energy({model, state, pool, nullptr, kept});
}

TEST_CASE("a static body feels no force, and has no energy of it") {
  for (const Example& example : examples()) {
    Model model = example.start.model;
    model.bodies.front().kind = BodyKind::immovable;
    CAPTURE(example.name);
    CHECK_FALSE(any_feels(model, *example.row));
    if (example.row->warnings != nullptr) CHECK(example.row->warnings(model, deformed(example.start, 1)).empty());
    if (example.row->make != nullptr) CHECK(energy_of(*example.row, model, deformed(example.start, 0.1)) == 0);
  }
}

TEST_CASE("forces within a body sum up to no force and no torque") {
  const auto all = examples();  // before devices, which know the kernels of their time
  const auto device = make_cpu_device(2, 64);
  for (const auto& [name, row, start] : all) {
    CAPTURE(name);
    const State state = deformed(start, 0.1);
    const auto forces = forces_at(*device, start.model, state);
    glm::dvec3 sum(0.0), torque(0.0);
    for (std::size_t i = 0; i < forces.size(); ++i) {
      sum += forces[i];
      torque += glm::cross(position(start.model, state, i), forces[i]);
    }
    const double size = size_of(forces);
    REQUIRE(size > 0);
    CHECK(glm::length(sum) < 1e-12 * size);
    CHECK(glm::length(torque) < 1e-12 * size);
  }
}

TEST_CASE("a turned body has turned forces") {
  const auto all = examples();  // before devices, which know the kernels of their time
  const auto device = make_cpu_device(1, 64);
  const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(0.8, glm::normalize(glm::dvec3(1, -2, 0.5))));
  for (const auto& [name, row, start] : all) {
    CAPTURE(name);
    const State state = deformed(start, 0.1);
    State turned = state;
    for (std::size_t i = 0; i < start.model.vertex_count(); ++i) {
      const glm::dvec3 u =
          turn * position(start.model, state, i) + glm::dvec3(3, -1, 2) - glm::dvec3(start.model.rest_positions[i]);
      for (int k = 0; k < 3; ++k) turned.motion[6 * i + static_cast<std::size_t>(k)] = u[k];
    }
    auto expected = forces_at(*device, start.model, state);
    for (glm::dvec3& force : expected) force = turn * force;
    const auto forces = forces_at(*device, start.model, turned);
    CHECK(largest_distance(forces, expected) < 1e-12 * size_of(expected));
    CHECK(energy_of(*row, start.model, turned) == Approx(energy_of(*row, start.model, state)).epsilon(1e-12));
  }
}

TEST_CASE("a body at rest feels the forces that are not zero there, and no others") {
  const auto all = examples();  // before devices, which know the kernels of their time
  const auto device = make_cpu_device(1, 64);
  for (const auto& [name, row, start] : all) {
    CAPTURE(name);
    const double size = size_of(forces_at(*device, start.model, start.state));
    CHECK((size == 0) == row->is_zero_at_rest);
  }
}

TEST_CASE("a force is minus the slope of its energy") {
  const auto all = examples();  // before devices, which know the kernels of their time
  const auto device = make_cpu_device(1, 64);
  constexpr double step = 1e-5;  // [m]
  for (const auto& [name, row, start] : all) {
    CAPTURE(name);
    const State state = deformed(start, 0.1);
    const auto forces = forces_at(*device, start.model, state);
    const double size = size_of(forces);
    for (const std::size_t i : {0, 7, 41})
      for (int k = 0; k < 3; ++k) {
        State ahead = state, behind = state;
        ahead.motion[6 * i + static_cast<std::size_t>(k)] += step;
        behind.motion[6 * i + static_cast<std::size_t>(k)] -= step;
        const double slope = (energy_of(*row, start.model, ahead) - energy_of(*row, start.model, behind)) / (2 * step);
        CHECK(std::abs(forces[i][k] + slope) < 1e-8 * size);
      }
  }
}

TEST_CASE("every device has the same forces but for rounding", "[gl]") {
  const auto all = examples();  // before devices, which know the kernels of their time
  const auto reference = make_cpu_device(1, 64);
  for (const auto& [name, row, start] : all) {
    const State state = deformed(start, 0.1);
    const auto expected = forces_at(*reference, start.model, state);
    for (const TestDevice& test : all_devices()) {
      CAPTURE(name, test.name);
      const double tolerance = test.device->precision() == 64 ? 1e-15 : 1e-6;
      CHECK(largest_distance(forces_at(*test.device, start.model, state), expected) < tolerance * size_of(expected));
    }
  }
}

// The largest eigenvalue of the forces' slope [N/m], by power iteration on differences.
double stiffness_at(Device& device, const Model& model, const State& state) {
  constexpr double step = 1e-5;  // [m]
  const std::size_t count = model.vertex_count();
  std::vector<glm::dvec3> direction(count);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (glm::dvec3& part : direction) part = {normal(random), normal(random), normal(random)};
  double stiffness = 0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    double norm = 0;
    for (const glm::dvec3& part : direction) norm += glm::dot(part, part);
    State ahead = state, behind = state;
    for (std::size_t i = 0; i < count; ++i)
      for (int k = 0; k < 3; ++k) {
        ahead.motion[6 * i + static_cast<std::size_t>(k)] += step * direction[i][k] / std::sqrt(norm);
        behind.motion[6 * i + static_cast<std::size_t>(k)] -= step * direction[i][k] / std::sqrt(norm);
      }
    const auto a = forces_at(device, model, ahead), b = forces_at(device, model, behind);
    stiffness = 0;
    for (std::size_t i = 0; i < count; ++i) {
      direction[i] = (b[i] - a[i]) / (2 * step);
      stiffness += glm::dot(direction[i], direction[i]);
    }
    stiffness = std::sqrt(stiffness);
  }
  return stiffness;
}

State stretched(const ModelAndState& start, const glm::dvec3& factors) {
  State state = start.state;
  for (std::size_t i = 0; i < start.model.vertex_count(); ++i)
    for (int k = 0; k < 3; ++k)
      state.motion[6 * i + static_cast<std::size_t>(k)] =
          (factors[k] - 1) * static_cast<double>(start.model.rest_positions[i][k]);
  return state;
}

constexpr double aside = 1e-10;  // so that rounding does not decide whether a volume is above the half
const glm::dvec3 flattened(1, 1, 0.5 + aside), shrunk(std::cbrt(0.5) + aside), grown(1.5);

TEST_CASE("no small motion is stiffer than the forces say down to half the volume, and the stiffest one is not far below") {
  const auto all = examples();  // before devices, which know the kernels of their time
  const auto device = make_cpu_device(2, 64);
  for (const auto& [name, row, start] : all) {
    const ModelBody& body = start.model.bodies.front();
    const double said = row->frequency_squared(body) * body.vertex_mass;
    double most = 0;
    for (const glm::dvec3& factors : {glm::dvec3(1), flattened, shrunk, grown}) {
      const State state = stretched(start, factors);
      CAPTURE(name, factors.x, factors.z);
      const double measured = stiffness_at(*device, start.model, state);
      CHECK(measured <= 1.0001 * said);
      if (row->warnings != nullptr) CHECK(row->warnings(start.model, state).empty());
      most = std::max(most, measured);
    }
    CAPTURE(name, said, most);
    CHECK(said < 5 * most);
  }
}

TEST_CASE("a force that warns does so of each shape in which it is stiffer than it says") {
  const auto all = examples();  // before devices, which know the kernels of their time
  const auto device = make_cpu_device(2, 64);
  bool any = false;
  for (const auto& [name, row, start] : all) {
    if (row->warnings == nullptr) continue;
    const ModelBody& body = start.model.bodies.front();
    for (const glm::dvec3& factors :
         {glm::dvec3(2, 2, 0.125 + aside), glm::dvec3(0.6, 0.6, 2), glm::dvec3(2.6), glm::dvec3(0.7)}) {
      const State state = stretched(start, factors);
      CAPTURE(name, factors.x, factors.z);
      if (stiffness_at(*device, start.model, state) <= 1.0001 * row->frequency_squared(body) * body.vertex_mass) continue;
      any = true;
      CHECK(row->warnings(start.model, state).size() == 1);
    }
  }
  CHECK(any);
}

}  // namespace
}  // namespace pliant
