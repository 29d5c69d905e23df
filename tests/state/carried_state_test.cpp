// A simulation that goes on from another's saved state is that simulation, to the bit.
#include "state/carried_state.hpp"

#include <catch2/catch.hpp>
#include <cstring>

#include "support/collision_scene.hpp"
#include "support/expect_error.hpp"

namespace pliant {
namespace {

void check_same(Simulation& a, Simulation& b) {
  const State of_a = a.state(), of_b = b.state();
  CHECK(of_a.motion == of_b.motion);
  REQUIRE(of_a.poses.size() == of_b.poses.size());
  CHECK(std::memcmp(of_a.poses.data(), of_b.poses.data(), of_a.poses.size() * sizeof(physics::Pose)) == 0);
  CHECK(a.world_positions() == b.world_positions());
  StepReport report_of_b = b.report();
  report_of_b.quiet_steps = a.report().quiet_steps;  // a run that goes on looks for them at other steps
  CHECK(a.report() == report_of_b);
  CHECK(a.collider().touching().marks() == b.collider().touching().marks());
}

// Bodies are somewhere else and move in another way, so that whatever is not restored shows.
State another_start(const ModelAndState& start) {
  State other = start.state;
  for (std::size_t k = 0; k < other.motion.size(); ++k) other.motion[k] += 0.01 * static_cast<double>(k % 7);
  return other;
}

ModelAndState colliding(double pressure) {
  std::vector<BodySetup> setups = colliding_spheres();
  for (BodySetup& setup : setups) setup.description.pressure = pressure;
  return build_model(setups, {0, -1, 0});
}

void check_fixed(Device& device, const Method& method, const CollisionDescription& collision, double pressure = 0) {
  const ModelAndState start = colliding(pressure);
  const TimePlan plan = plan_of(method);
  Simulation whole(device, start.model, start.state, plan, collision);
  whole.advance(25);
  CHECK(whole.report().contact_steps >= 5);
  for (const std::uint64_t cut : {1u, 9u, 16u}) {
    CAPTURE(cut);
    Simulation first(device, start.model, start.state, plan, collision);
    first.advance(cut);
    Simulation second(device, start.model, another_start(start), plan, collision);
    second.advance(3);
    second.restore(first.save());
    check_same(first, second);
    second.advance(25 - cut);
    check_same(whole, second);
  }
}

// Drivers may order writes and dispatches in their own way.
TEST_CASE("what is restored in the midst of work stands", "[gl]") {
  const ModelAndState start = build_model(colliding_spheres(), {0, -1, 0});
  const TimePlan plan = plan_of({"verlet", 0.01});
  for (const TestDevice& test : all_devices()) {
    Simulation first(*test.device, start.model, start.state, plan, {});
    first.advance(12);
    const std::string saved = first.save();
    for (int k = 0; k < 20; ++k) {
      CAPTURE(test.name, k);
      Simulation second(*test.device, start.model, another_start(start), plan, {});
      second.advance(static_cast<std::uint64_t>(k % 4));
      second.restore(saved);
      CHECK(second.save() == saved);
    }
  }
}

TEST_CASE("fixed steps go on from a saved state to the bit, with stages and kept forces, through contacts", "[gl][long]") {
  const CollisionDescription by_tree{.response = {"reflect"}};
  CollisionDescription by_force = by_tree;
  by_force.search = ContactSearch::brute_force;
  for (const TestDevice& test : all_devices())
    for (const Method& method :
         {Method{"cv8", 0.01, DampingLaw::adaptive}, Method{"verlet", 0.01, DampingLaw::adaptive}, Method{"srkn11b", 0.01},
          Method{"dprkn8", 0.01, DampingLaw::constant}, Method{"verlet", 0.01, DampingLaw::internal}}) {
      CAPTURE(test.name, method.integrator);
      check_fixed(*test.device, method, by_tree);
      check_fixed(*test.device, method, by_tree, 3);
      if (test.name != "gpu") check_fixed(*test.device, method, by_force);
    }
}

TEST_CASE("contact by impulses goes on from a saved state to the bit", "[gl]") {
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    check_fixed(*test.device, {"verlet", 0.01, DampingLaw::constant}, {.response = {"impulse"}, .elasticity = 0});
  }
}

TEST_CASE("impulses of contacts with two grounds and a body are restored, each with its ground", "[gl]") {
  std::vector<BodySetup> setups = colliding_spheres();
  for (BodySetup& setup : setups) setup.description.velocity = setup.description.spin = {0, 0, 0};
  setups[0].description.position = {-1.03, 1.3, 0};
  setups[1].description.position = {1.03, 1.35, 0.05};
  std::vector<GroundDescription> wedge(2);
  wedge[0].normal = {0.6, 0.8, 0};
  wedge[1].normal = {-0.6, 0.8, 0};
  const ModelAndState start = build_model(setups, {0, -9.81, 0}, wedge);
  const TimePlan plan = plan_of({"verlet", 0.01, DampingLaw::constant});
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Simulation first(*test.device, start.model, start.state, plan, {.response = {"impulse"}, .elasticity = 0});
    first.advance(150);
    REQUIRE(first.contact_impulses().size() > 4);
    const std::string saved = first.save();
    Simulation second(*test.device, start.model, start.state, plan, {.response = {"impulse"}, .elasticity = 0});
    second.restore(saved);
    CHECK(second.save() == saved);
    for (Simulation* simulation : {&first, &second}) simulation->advance(20);
    check_same(first, second);
  }
}

void check_adaptive(Device& device, const Adaptive& adaptive, const char* response, double pressure) {
  constexpr double duration = 1;  // [s]
  const ModelAndState start = colliding(pressure);
  const TimePlan plan = plan_of(adaptive, start.model);
  Simulation whole(device, start.model, start.state, plan, {.response = {response}});
  const StepReport end = whole.advance_to(duration);
  CHECK(end.contact_steps > 0);
  if (std::string_view(response) == "reflect") CHECK(end.adaptive->rejected > 0);
  for (const int batches : {1, 2}) {
    CAPTURE(batches);
    Simulation first(device, start.model, start.state, plan, {.response = {response}});
    for (int k = 0; k < batches; ++k) static_cast<void>(first.advance_toward(duration));
    CHECK(first.report().time < duration);
    Simulation second(device, start.model, another_start(start), plan, {.response = {response}});
    static_cast<void>(second.advance_toward(0.01));
    second.restore(first.save());
    check_same(first, second);
    static_cast<void>(second.advance_to(duration));
    check_same(whole, second);
  }
}

TEST_CASE("steps of adaptive length go on from a saved state to the bit, with their controller", "[gl][long]") {
  for (const TestDevice& test : all_devices())
    for (const Adaptive& adaptive : {Adaptive{"dop853", 1e-6, {}, DampingLaw::adaptive}, Adaptive{"dprkn8", 1e-6}}) {
      CAPTURE(test.name, adaptive.integrator);
      for (const char* response : {"reflect", "impulse"})
        for (const double pressure : {0.0, 3.0}) check_adaptive(*test.device, adaptive, response, pressure);
    }
}

TEST_CASE("looking at a simulation, or saving it, changes nothing") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const auto device = make_cpu_device(2, 32);
  const TimePlan plan = plan_of(Method{"verlet", 0.01, DampingLaw::adaptive});
  for (const char* response : {"impulse", "reflect"}) {
    CAPTURE(response);
    const CollisionDescription collision{.response = {response}};
    Simulation watched(*device, start.model, start.state, plan, collision),
        alone(*device, start.model, start.state, plan, collision);
    for (int step = 0; step < 20; ++step) {
      watched.advance(1);
      const std::string before = watched.save();
      static_cast<void>(watched.intersections());
      CHECK(watched.save() == before);
    }
    alone.advance(20);
    CHECK(alone.report().contact_steps > 0);
    check_same(watched, alone);
  }
}

TEST_CASE("a saved state goes on in the other precision, up to rounding") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0});
  const TimePlan plan = plan_of(Method{"verlet", 0.005, DampingLaw::adaptive});
  CollisionDescription none;
  none.response = Named{"none"};
  const auto single = make_cpu_device(2, 32), whole = make_cpu_device(2, 64);
  for (const auto& [from, to] : {std::pair(single.get(), whole.get()), std::pair(whole.get(), single.get())}) {
    Simulation first(*from, start.model, start.state, plan, none), second(*to, start.model, another_start(start), plan, none);
    first.advance(7);
    second.restore(first.save());
    first.advance(30);
    second.advance(30);
    const double apart = distance(first.state().world_positions(start.model), second.state().world_positions(start.model));
    CHECK(apart > 0);
    CHECK(apart < 1e-5);
  }
}

TEST_CASE("a saved state of other bodies or of another kind of steps is refused") {
  const ModelAndState start = build_model(colliding_spheres(), {0, 0, 0}), other = built(sphere(1));
  const auto device = make_cpu_device(1, 32);
  const TimePlan plan = plan_of(Method{"dop853", 0.01});
  Simulation simulation(*device, start.model, start.state, plan, {}), smaller(*device, other.model, other.state, plan, {}),
      adaptive(*device, start.model, start.state, plan_of(Adaptive{}, start.model), {});
  const std::string saved = simulation.save();
  CHECK(error_of([&] { smaller.restore(saved); }).kind() == ErrorKind::input);
  CHECK(error_of([&] { adaptive.restore(saved); }).kind() == ErrorKind::input);
  CHECK(error_of([&] { simulation.restore(adaptive.save()); }).kind() == ErrorKind::input);
  CHECK(error_of([&] { simulation.restore(saved.substr(0, saved.size() - 1)); }).kind() == ErrorKind::input);
}

}  // namespace
}  // namespace pliant
