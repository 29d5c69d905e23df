// Ranks that sum springs together: threads of this process here.
#include "dynamics/shared_sums.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <functional>

#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "simulation/simulation.hpp"
#include "support/clustered_bodies.hpp"
#include "support/evolve.hpp"
#include "support/has.hpp"
#include "support/thread_ranks.hpp"

namespace pliant {
namespace {

constexpr const char* bodies = R"(
[[body]]
name = "large"
mesh = "icosphere:3"
position = [-1.1, 0.1, 0]
velocity = [4, 0, 0]
spin = [0, 1, 0]
stiffness = 2
damping = 0.01
[[body]]
mesh = "icosphere:1"
pressure = 2
position = [1.1, 0, 0]
stretch = [0.9, 1, 1]
[[body]]
mesh = "cube:2"
position = [0, -3, 0]
kind = "static"
)";

using MakeDevice = std::function<std::unique_ptr<Device>()>;

struct Reached {
  std::vector<double> motion;
  std::vector<std::uint64_t> evaluations;  // of springs' forces
};

// Returns what comes out of the work on each rank.
std::vector<Reached> reached_by(std::size_t ranks, const MakeDevice& make_device, const std::function<Reached(Device&)>& work) {
  std::vector<Reached> reached(ranks);
  test::on_ranks(ranks, [&](Ranks& own) {
    const auto device = make_device();
    if (ranks > 1) device->join(&own);
    reached[own.number()] = work(*device);
  });
  return reached;
}

void check_as_alone(std::size_t ranks, const MakeDevice& make_device, const std::function<Reached(Device&)>& work) {
  CAPTURE(ranks);
  const Reached alone = reached_by(1, make_device, work).front();
  for (const Reached& together : reached_by(ranks, make_device, work)) {
    CHECK(std::memcmp(together.motion.data(), alone.motion.data(), alone.motion.size() * sizeof(double)) == 0);
    CHECK(together.evaluations == alone.evaluations);
  }
}

// Of a whole simulation.
Reached simulate(Device& device, const std::string& simulation) {
  const SceneDescription scene = parse_scene("[simulation]\n" + simulation + bodies, "shared");
  const auto [model, start] = build_model(load_bodies(scene), scene.simulation.gravity, scene.grounds);
  const TimePlan plan = plan_time(scene, model);
  Simulation run(device, model, start, plan, scene.collision);
  if (plan.tolerance)
    run.advance_to(0.08);
  else
    run.advance(40);
  return {run.state().motion, {run.report().force_evaluations}};
}

TEST_CASE("ranks that share sums give the bits of one alone, with every kind of method and damping", "[gl]") {
  const std::string simulation = GENERATE(
      "integrator = \"dop853\"\ntime_step = 0.002\n",  //
      "integrator = \"verlet\"\ntime_step = 0.002\n", "integrator = \"cv8\"\ntime_step = 0.002\ngravity = [0, -9.81, 0]\n",
      "integrator = \"dop853\"\ntolerance = 1e-6\n", "integrator = \"cv8\"\ntime_step = 0.002\ndamping_law = \"internal\"\n",
      "integrator = \"verlet\"\ntime_step = 0.002\ndamping_law = \"adaptive\"\n");
  CAPTURE(simulation);
  const auto work = [&](Device& device) { return simulate(device, simulation); };
  for (const std::size_t ranks : {2u, 3u})
    for (const int precision : {32, 64})
      check_as_alone(
          ranks, [=] { return make_cpu_device(1, precision); }, work);
  if (test::has_gl())
    check_as_alone(
        2, [] { return make_gpu_device(0); }, work);
}

// Three steps, with one force variant for all bodies. Drags differ, so a Nystrom method has a tableau for each.
Reached after_steps(Device& device, const Method& method, std::size_t variant) {
  std::vector<BodySetup> setups{sphere(3), sphere(2)};
  setups[0].description.stretch = {0.8, 1.1, 1};
  setups[0].description.damping = 0.3;
  setups[1].description.stretch = {1, 0.9, 1};
  setups[1].description.position = {5, 0, 0};
  const ModelAndState start = build_model(setups, {0, 0, 0});
  DeviceBodies made(device, start.model, start.state, variant);
  made.run_all_stages(false);
  const Stepper stepper(made, start.model, find_integrator(method.integrator), method.law, method.time_step);
  device.run(stepper.first_passes());
  for (std::uint32_t step = 0; step < 3; ++step) device.run(stepper.passes(step % 2));
  Reached reached{made.download(1).motion, {}};
  for (const physics::Tally& tally : made.tallies.download()) reached.evaluations.push_back(tally.force_evaluations);
  return reached;
}

TEST_CASE("ranks that share sums give the bits of one alone, whichever variant that one has", "[gl]") {
  if (!test::has_gl()) return;
  const Method method = GENERATE(Method{"verlet", 0.01, DampingLaw::constant}, Method{"cv8", 0.02, DampingLaw::adaptive},
                                 Method{"dprkn8", 0.02, DampingLaw::constant});
  CAPTURE(method.integrator);
  const std::size_t count = make_gpu_device(0)->force_variants().size();
  for (std::size_t variant = 0; variant < count; ++variant) {
    CAPTURE(variant);
    check_as_alone(
        2, [] { return make_gpu_device(0); }, [&](Device& device) { return after_steps(device, method, variant); });
  }
}

// A thread serves each small body alone. Others are cut.
TEST_CASE("ranks share the sums of many bodies, small and larger") {
  std::vector<BodySetup> setups;
  for (int b = 0; b < 40; ++b) {
    setups.push_back(sphere(b % 3 == 0 ? 2 : 3));
    setups.back().description.stretch = {0.8, 1.1, 1};
    setups.back().description.position = {5.0 * b, 0, 0};
  }
  const ModelAndState start = build_model(setups, {0, 0, 0});
  for (const int precision : {32, 64})
    check_as_alone(
        3, [=] { return make_cpu_device(2, precision); },
        [&](Device& device) {
          Simulation run(device, start.model, start.state, plan_of({"verlet", 0.01}), no_contacts);
          run.advance(5);
          return Reached{run.state().motion, {run.report().force_evaluations}};
        });
}

TEST_CASE("ranks exchange kept forces only where these do not hold") {
  const auto sharings_of = [](std::uint32_t steps) {
    std::vector<std::uint64_t> sharings(2);
    test::on_ranks(2, [&](test::ThreadRanks& own) {
      const auto device = make_cpu_device(1, 32);
      device->join(&own);
      const ModelAndState start = deformed_sphere(3, "dent");
      Simulation run(*device, start.model, start.state, plan_of({"verlet", 0.001}), no_contacts);
      run.advance(steps);
      sharings[own.number()] = own.sharings();
    });
    CHECK(sharings[0] == sharings[1]);
    return sharings[0];
  };
  CHECK(sharings_of(1) == 2);  // those at the start, and those at the end
  CHECK(sharings_of(10) == 11);
}

TEST_CASE("ranks share the sums of a body that is no longer clustered", "[gl]") {
  const auto work = [](Device& device) {
    ModelAndState start = clustered(deformed_sphere(3, "dent"));
    ChangedSums all_springs;
    all_springs.are_direct = true;
    start.state.changed_sums = {std::make_shared<const ChangedSums>(all_springs)};
    Simulation run(device, start.model, start.state, plan_of({"cv8", 0.01}), no_contacts);
    run.advance(3);
    return Reached{run.state().motion, {run.report().force_evaluations, run.report().pair_interactions}};
  };
  check_as_alone(
      2, [] { return make_cpu_device(1, 32); }, work);
  if (test::has_gl())
    check_as_alone(
        2, [] { return make_gpu_device(0); }, work);
}

}  // namespace
}  // namespace pliant
