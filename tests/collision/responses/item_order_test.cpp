// A GPU gives the items of a kernel to threads in any order. Runs must have the same bits whatever that is.
#include <catch2/catch.hpp>

#include "device/gpu/gpu_device.hpp"
#include "mesh/generators.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "simulation/skipping.hpp"
#include "simulation/time_plan.hpp"
#include "support/evolve.hpp"
#include "support/has.hpp"
#include "support/impulse_scene.hpp"
#include "support/paths.hpp"

namespace pliant {
namespace {

// The end of a run that searches for contacts in each step, and what its contacts gave.
struct End {
  std::vector<double> motion;
  double energy_given, energy_taken, friction_work;

  bool operator==(const End&) const = default;
};

End end_of(const ModelAndState& start, const TimePlan& plan, const CollisionDescription& collision, int steps, ItemOrder order) {
  const auto device = make_gpu_device(0, order);
  Simulation run(*device, start.model, start.state, plan, collision);
  run.skip(skip_nothing);
  run.advance(static_cast<std::uint64_t>(steps));
  CHECK(run.report().contact_steps > 0);
  const ResponseReport gave = run.report().response;
  return {run.state().motion, gave.energy_given, gave.energy_taken, gave.friction_work};
}

void check_order(const ModelAndState& start, const TimePlan& plan, const CollisionDescription& collision, int steps) {
  const auto end = [&](ItemOrder order) { return end_of(start, plan, collision, steps, order); };
  CHECK(end(ItemOrder::ascending) == end(ItemOrder::descending));
}

TEST_CASE("the order of items does not matter where a body meets itself", "[gl][long]") {
  if (test::lacks_gl()) return;
  BodySetup ball = soft(generate_mesh("icosphere:1"), "ball");
  ball.description.self_contact = true;
  ball.description.stretch = {1.1, 0.95, 1};
  ModelAndState start = build_model(std::vector{ball}, glm::dvec3(0.0));
  set_velocities(start, [](const glm::dvec3& x) { return -60.0 * x; });  // it would turn inside out
  check_order(start, plan_of(Method{"verlet", 0.01}), by_impulses, 4);
}

TEST_CASE("the order of items does not matter where several bodies bounce", "[gl][long]") {
  if (test::lacks_gl()) return;
  std::vector<BodySetup> setups;
  for (int k = 0; k < 3; ++k) {
    BodySetup& ball = setups.emplace_back(soft(generate_mesh("icosphere:1"), "ball"));
    ball.description.restitution = 0.8;
    ball.description.position = {2.1 * k, 0.3 * k, 0.1};
    ball.description.velocity = {k == 0 ? 6 : -3 * k, 0, 0};
  }
  check_order(build_model(setups, glm::dvec3(0.0)), plan_of(Method{"verlet", 0.01}), by_impulses, 12);
}

TEST_CASE("the order of items does not matter in a stack", "[gl][long]") {
  if (test::lacks_gl()) return;
  const SceneDescription stack = load_scene(source_dir() + "/scenes/demos/jelly_stack.toml");
  const ModelAndState start = build_model(load_bodies(stack), stack.simulation.gravity, stack.grounds);
  check_order(start, plan_time(stack, start.model), stack.collision, 40);
}

}  // namespace
}  // namespace pliant
