// Compares stages that one dispatch runs, with work groups that wait for each other, to a dispatch a stage.
#include <catch2/catch.hpp>

#include "simulation/step_passes.hpp"
#include "support/evolve.hpp"

namespace pliant {
namespace {

// Two bodies of at most `vertices` vertices, which may fit in one work group or not. Only the first one is deformed and moves.
ModelAndState bodies_of(int level, std::uint32_t vertices) {
  std::vector<BodySetup> setups{sphere(level), sphere(level)};
  for (BodySetup& setup : setups) {
    setup.mesh.triangles.clear();
    setup.mesh.positions.resize(std::min<std::size_t>(setup.mesh.positions.size(), vertices));
  }
  setups[0].description.stretch = {0.8, 1.1, 1};
  setups[0].description.velocity = {1, 2, 3};
  setups[1].description.position = {5, 0, 0};
  return build_model(setups, {0, -1, 0});
}

struct Outcome {
  std::vector<double> motion;
  std::vector<std::uint32_t> counts, force_stale;  // of the bodies
  bool operator==(const Outcome&) const = default;
};

Outcome outcome_of(const DeviceBodies& bodies, std::uint32_t half) {
  Outcome outcome{bodies.download(half).motion, bodies.arrays.get<std::uint32_t>("meeting").download(), {}};
  for (const physics::Tally& tally : bodies.tallies.download())
    outcome.counts.insert(outcome.counts.end(), {tally.force_evaluations, tally.forces_skipped});
  const std::vector<physics::Status> statuses = bodies.statuses.download();
  for (std::uint32_t b = 0; b < bodies.body_count; ++b) outcome.force_stale.push_back(statuses[b].force_stale);
  return outcome;
}

// As a contact leaves them: the forces that a splitting has kept no longer hold.
void spoil_kept_forces(DeviceBodies& bodies) {
  auto& kept = bodies.arrays.get<double>("kept_force");
  kept.upload(std::vector<double>(kept.size(), 1e3));
  std::vector<physics::Status> statuses = bodies.statuses.download();
  for (physics::Status& status : statuses) status.force_stale = 1;
  bodies.statuses.upload(statuses);
}

Outcome after_five_steps(Device& device, const ModelAndState& start, const Method& method, std::size_t variant, bool all_stages) {
  DeviceBodies bodies(device, start.model, start.state, variant);
  bodies.run_all_stages(all_stages);
  const Stepper stepper(bodies, start.model, find_integrator(method.integrator), method.law, method.time_step);
  device.run(stepper.first_passes());
  const std::size_t passes = stepper.passes(0).size();
  CHECK((all_stages ? passes == 1 : passes >= stepper.stage_count()));
  for (std::uint32_t step = 0; step < 5; ++step) {
    if (step == 3) spoil_kept_forces(bodies);
    device.run(stepper.passes(step % 2));
    for (const Pass& pass : {stepper.following_pass(step % 2), stepper.restating_pass(step % 2)}) device.run({&pass, 1});
  }
  return outcome_of(bodies, 1);
}

struct AdaptiveOutcome {
  Outcome outcome;
  std::uint32_t accepted, rejected, verdict;
  double time, allowed;
  bool operator==(const AdaptiveOutcome&) const = default;
};

// Steps by vern8, whose estimates take one stage more. The first step is so long that it is rejected. The last one is empty.
AdaptiveOutcome after_adaptive_steps(Device& device, const ModelAndState& start, std::size_t variant, bool all_stages) {
  const double omega = stiffest_omega(start.model);
  const TimePlan plan = plan_of(Adaptive{"vern8", 1e-5, 4 / omega, DampingLaw::constant}, start.model);
  DeviceBodies bodies(device, start.model, start.state, variant);
  bodies.run_all_stages(all_stages);
  const Stepper stepper(bodies, start.model, *plan.integrator, plan.damping_law, plan.time_step, Stages::of_estimates);
  Pacer pacer(bodies, start.model, stepper, *plan.integrator, plan.damping_law,
              {.tolerance = *plan.tolerance, .first_step = plan.time_step, .largest_step = plan.step_bound});
  const Collider collider(bodies, start.model, {.response = {"none"}});
  device.run(stepper.first_passes());
  pacer.aim_at(6 / omega);
  for (std::uint32_t step = 0; step < 24; ++step) device.run(step_passes(bodies, stepper, collider, step % 2, &pacer));
  const physics::Pace pace = pacer.pace();
  return {outcome_of(bodies, 0), pace.accepted, pace.rejected, pace.verdict, pace.time, pace.allowed};
}

void check_adaptive(Device& device, const ModelAndState& start, std::size_t variant) {
  CAPTURE(device.force_variants()[variant].name, start.model.vertex_count());
  const AdaptiveOutcome one_by_one = after_adaptive_steps(device, start, variant, false);
  CAPTURE(one_by_one.accepted, one_by_one.rejected);
  REQUIRE((one_by_one.rejected > 0 && one_by_one.verdict == physics::step_empty));
  CHECK(after_adaptive_steps(device, start, variant, true) == one_by_one);
}

void check_all_stages(Device& device, const ModelAndState& start, std::size_t variant) {
  CAPTURE(device.force_variants()[variant].name, start.model.vertex_count());
  for (const Method& method :
       {Method{"cv8", 0.05, DampingLaw::adaptive}, {"rk4", 0.05}, {"srkn11b", 0.05}, {"verlet", 0.05, DampingLaw::constant}}) {
    CAPTURE(method.integrator);
    const Outcome one_by_one = after_five_steps(device, start, method, variant, false);
    REQUIRE(one_by_one.motion != start.state.motion);
    const bool is_splitting = staged_method(find_integrator(method.integrator)) == nullptr;
    CHECK((!is_splitting || one_by_one.force_stale == std::vector<std::uint32_t>{0, 0}));
    CHECK(after_five_steps(device, start, method, variant, true) == one_by_one);
  }
}

// Calls check(device, start, variant) for every force variant that can run all stages. Bodies have one work group each. A second
// call has bodies with many, if they fit.
template <class Check>
void for_each_variant(Check check) {
  for (const TestDevice& test : all_devices())
    for (std::size_t variant = 0; variant < test.device->force_variants().size(); ++variant) {
      const ForceVariant& lanes = test.device->force_variants()[variant];
      if (!lanes.all_stages) continue;
      check(*test.device, bodies_of(1, lanes.share_size), variant);
      const ModelAndState large = bodies_of(3, ~0u);
      if (large.model.vertex_count() <= test.device->shares_at_once() * lanes.share_size) check(*test.device, large, variant);
    }
}

// The motion after some steps, with a force variant for each body.
std::vector<double> motion_by(Device& device, const ModelAndState& start, const Method& method,
                              const std::vector<std::size_t>& variants) {
  DeviceBodies bodies(device, start.model, start.state, variants);
  bodies.run_all_stages(false);
  const Stepper stepper(bodies, start.model, find_integrator(method.integrator), method.law, method.time_step);
  device.run(stepper.first_passes());
  for (std::uint32_t step = 0; step < 4; ++step) {
    device.run(stepper.passes(step % 2));
    for (const Pass& pass : {stepper.following_pass(step % 2), stepper.restating_pass(step % 2)}) device.run({&pass, 1});
  }
  return bodies.download(0).motion;
}

// How a body moves depends on its own variant alone.
TEST_CASE("each body has its own force variant", "[gl]") {
  std::vector<BodySetup> setups{sphere(1), sphere(2), sphere(1), sphere(3)};
  for (BodySetup& setup : setups) setup.description.stretch = {0.8, 1.1, 1};
  const ModelAndState start = build_model(setups, {0, -1, 0});
  const auto of_body = [&](const std::vector<double>& motion, std::size_t b) {
    const ModelBody& body = start.model.bodies[b];
    const auto first = motion.begin() + physics::motion_size * body.first_vertex;
    return std::vector(first, first + physics::motion_size * body.vertex_count);
  };
  for (const TestDevice& test : all_devices())
    for (const Method& method : {Method{"verlet", 0.05}, Method{"rk4", 0.05, DampingLaw::constant}}) {
      const std::size_t variants = test.device->force_variants().size();
      std::vector<std::vector<double>> alone;
      for (std::size_t variant = 0; variant < variants; ++variant)
        alone.push_back(motion_by(*test.device, start, method, std::vector(start.model.bodies.size(), variant)));
      for (std::size_t k = 0; k < variants; ++k) {
        const std::vector<std::size_t> chosen = {k, (k + 1) % variants, (k + 2) % variants, k};
        const std::vector<double> mixed = motion_by(*test.device, start, method, chosen);
        CAPTURE(test.name, method.integrator, k);
        for (std::size_t b = 0; b < chosen.size(); ++b) CHECK(of_body(mixed, b) == of_body(alone[chosen[b]], b));
      }
    }
}

TEST_CASE("all stages in one dispatch give the very bits of a dispatch a stage", "[gl]") { for_each_variant(check_all_stages); }

TEST_CASE("so do adaptive steps, rejected and empty ones among them", "[gl]") { for_each_variant(check_adaptive); }

TEST_CASE("a device that does not say how many work groups run at once never lets those of a body wait for each other", "[gl]") {
  const ModelAndState start = bodies_of(3, ~0u);
  for (const TestDevice& test : all_devices())
    if (test.device->shares_at_once() == 0)
      CHECK(std::ranges::none_of(DeviceBodies(*test.device, start.model, start.state).force_groups, &ForceGroup::all_stages));
}

}  // namespace
}  // namespace pliant
