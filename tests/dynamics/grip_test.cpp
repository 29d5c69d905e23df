// Bodies pulled by a part of their surface, gently and as hard as can be.
#include "dynamics/grip.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "support/collision_scene.hpp"
#include "support/shipped_scenes.hpp"

namespace pliant {
namespace {

constexpr double picture = 1.0 / 60;  // [s]

glm::dvec3 mean(const std::vector<glm::dvec3>& of) {
  return std::accumulate(of.begin(), of.end(), glm::dvec3(0.0)) / static_cast<double>(of.size());
}

BodySetup firm_sphere() {
  BodySetup setup = sphere(1);
  setup.description.stiffness = 16;
  return setup;
}

/// A sphere at rest.
struct Resting {
  explicit Resting(Device& device)
      : start(built(firm_sphere())),
        simulation(device, start.model, start.state, plan_of(Method{"dop853", 0.02, DampingLaw::constant}), {}) {}
  ModelAndState start;
  Simulation simulation;
};

TEST_CASE("a body comes to where it is drawn, and stays there", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Resting resting(*test.device);
    const glm::dvec3 target(3, 1, 0.5);
    for (int step = 0; step < 200; ++step) {
      resting.simulation.advance(1);
      resting.simulation.pull({.vertex = 7, .target = target}, 0.02);
    }
    const State end = resting.simulation.state();
    const glm::dvec3 centre = mean(end.world_positions(resting.start.model));
    CHECK(glm::distance(end.world_positions(resting.start.model)[7], target) < 0.3);
    CHECK(glm::distance(centre, target) < 1.1);
    CHECK(glm::length(mean(end.world_velocities(resting.start.model))) < 0.2);
  }
}

TEST_CASE("a pull changes velocities near its vertex towards the target, and nothing else", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Resting resting(*test.device);
    const Model& model = resting.start.model;
    const std::uint32_t held = 5;
    const glm::dvec3 target(0, 9, 0);
    resting.simulation.pull({.vertex = held, .target = target}, 1e-3);
    const State pulled = resting.simulation.state();
    const auto positions = pulled.world_positions(model), velocities = pulled.world_velocities(model);
    CHECK(positions == resting.start.state.world_positions(model));
    const double fastest = glm::length(velocities[held]);
    CHECK(glm::dot(velocities[held], target - positions[held]) > 0.9 * fastest * glm::distance(target, positions[held]));
    for (std::uint32_t i = 0; i < model.vertex_count(); ++i) {
      const double distance = glm::distance(positions[i], positions[held]);
      CHECK(glm::length(velocities[i]) <= fastest);
      CHECK((glm::length(velocities[i]) > 0) == (distance < 0.7 * model.bodies[0].radius));
    }
  }
}

/// A mouse that pulls wildly. At times it jumps about, pumps the body's motion, or presses the body into another one.
class WildMouse {
 public:
  explicit WildMouse(std::uint32_t vertex) : vertex_(vertex) {}
  Pull next(const Model& model, const State& state) {
    const glm::dvec3 position = state.world_positions(model)[vertex_], velocity = state.world_velocities(model)[vertex_];
    const int mood = picture_++ / 40 % 4;
    if (mood == 0) return {vertex_, 100.0 * glm::dvec3(jump_(random_), jump_(random_), jump_(random_))};
    if (mood == 1) return {vertex_, position + 100.0 * velocity};
    if (mood == 2) return {vertex_, -4.0 * position};
    return {vertex_, mean(state.world_positions(model))};
  }

 private:
  std::uint32_t vertex_;
  int picture_ = 0;
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> jump_{-1, 1};
};

/// What is left of a scene after that mouse.
struct Pulled {
  StepReport report;
  std::vector<glm::dvec3> positions;
};

Pulled pull_wildly(Device& device, const ModelAndState& start, const TimePlan& plan, const CollisionDescription& collision,
                   double duration /* [s] */) {
  Simulation simulation(device, start.model, start.state, plan, collision);
  WildMouse mouse(start.model.bodies.back().first_vertex);
  const auto steps = static_cast<std::uint64_t>(std::ceil(picture / plan.time_step));
  StepReport report;
  for (double time = 0; time < duration && !report.breakdown; time += picture) {
    const Pull pull = mouse.next(start.model, simulation.state());
    if (plan.tolerance) {
      report = simulation.advance_to(time + picture);
      simulation.pull(pull, picture);
      continue;
    }
    for (std::uint64_t done = 0; done < steps; done += 4) {  // some batches a picture
      const std::uint64_t batch = std::min<std::uint64_t>(4, steps - done);
      simulation.advance(batch);
      simulation.pull(pull, static_cast<double>(batch) * plan.time_step);
    }
    report = simulation.report();
  }
  return {report, simulation.state().world_positions(start.model)};
}

/// Checks that the last body, which was pulled, is in one piece.
void check_whole(const Model& model, const std::vector<glm::dvec3>& positions) {
  const ModelBody& pulled = model.bodies.back();
  const std::vector<glm::dvec3> of_pulled(positions.begin() + pulled.first_vertex, positions.end());
  for (const glm::dvec3& position : of_pulled) CHECK(glm::distance(position, mean(of_pulled)) < 10 * pulled.radius);
}

void check_bears(Device& device, const ModelAndState& start, const TimePlan& plan, double duration /* [s] */) {
  const Pulled end = pull_wildly(device, start, plan, {}, duration);
  CHECK_FALSE(end.report.breakdown);
  CHECK(end.report.contact_steps > 0);
  check_whole(start.model, end.positions);
}

/// Soft and stiff spheres that are about to meet.
ModelAndState meeting(double stiffness) {
  std::vector<BodySetup> setups = colliding_spheres();
  for (BodySetup& setup : setups) setup.description.stiffness = stiffness;
  return build_model(setups, {0, 0, 0});
}

TimePlan half_of_bound(std::string_view integrator, DampingLaw law, const Model& model) {
  double bound = picture;
  for (const ModelBody& body : model.bodies) bound = std::min(bound, step_bound(find_integrator(integrator), body, law));
  return plan_of(Method{integrator, bound / 2, law});
}

TEST_CASE("a minute of a wild mouse leaves bodies finite", "[long]") {
  const auto device = make_cpu_device(1, 32);
  for (const double stiffness : {0.05, 5.0, 500.0})
    for (const DampingLaw law : {DampingLaw::none, DampingLaw::adaptive}) {
      CAPTURE(stiffness, name_of(law));
      const ModelAndState start = meeting(stiffness);
      check_bears(*device, start, half_of_bound("verlet", law, start.model), 60);
    }
}

TEST_CASE("a wild mouse leaves soft and stiff bodies finite, with damping and without", "[gl][long]") {
  for (const TestDevice& test : all_devices())
    for (const double stiffness : {0.05, 5.0, 500.0})
      for (const DampingLaw law : {DampingLaw::none, DampingLaw::adaptive}) {
        const bool is_gpu = test.device->info().kind == DeviceKind::gpu;
        const bool is_end = law == DampingLaw::none ? stiffness == 0.05 : stiffness == 500;
        if (is_gpu && !is_end) continue;  // one in software takes long
        CAPTURE(test.name, stiffness, name_of(law));
        const ModelAndState start = meeting(stiffness);
        check_bears(*test.device, start, half_of_bound("verlet", law, start.model), 1);
        check_bears(*test.device, start, half_of_bound("dop853", law, start.model), 1);
        Adaptive adaptive{.law = law};
        check_bears(*test.device, start, plan_of(adaptive, start.model), 1);
      }
}

// This takes hours on few CPUs. Without damping a body tears, because nothing takes out again what the mouse puts into it.
TEST_CASE("a minute of a wild mouse leaves every scene whose step is stable finite, and damped bodies whole", "[.soak][gl]") {
  const std::vector<TestDevice> devices = all_devices();
  for (const char* name : {"two_spheres", "three_spheres", "soft_and_hard", "sphere_bunny", "bunny_teapot",
                           "bunnies_undamped_verlet", "bunnies_overdamped_verlet"}) {
    CAPTURE(name);
    const SceneDescription scene = test::load_shipped_scene(name);
    const ModelAndState start = build_model(load_bodies(scene), scene.simulation.gravity);
    const Pulled end = pull_wildly(*devices.back().device, start, plan_time(scene, start.model), scene.collision, 60);
    CHECK_FALSE(end.report.breakdown);
    for (const glm::dvec3& position : end.positions) CHECK(std::isfinite(glm::length(position)));
    if (damping_law_of(scene) != DampingLaw::none) check_whole(start.model, end.positions);
  }
}

}  // namespace
}  // namespace pliant
