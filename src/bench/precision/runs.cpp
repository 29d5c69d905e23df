#include "bench/precision/runs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/stopwatch.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

Run run_pliant(Device& device, const PrecisionCase& what, const TimePlan& plan, const std::function<void(Simulation&)>& advance) {
  Simulation simulation(device, what.start.model, what.start.state, plan, what.collision);
  device.finish();
  Stopwatch watch;
  watch.time([&] {
    advance(simulation);
    device.finish();
  });
  const StepReport report = simulation.report();
  Run run{.seconds = watch.seconds(),
          .evaluations = (report.force_evaluations + report.forces_skipped) / what.start.model.bodies.size(),
          .contact_steps = report.contact_steps,
          .ending = ending_of(what.start.model, simulation.state())};
  // If no step meets the tolerance, the state is finite, but of an earlier time.
  if (report.breakdown) std::ranges::fill(run.ending.velocities, glm::dvec3(NAN));
  return run;
}

}  // namespace

Run run_steps(Device& device, const PrecisionCase& what, const Integrator& integrator, std::uint64_t steps) {
  return run_pliant(device, what, what.plan_steps(integrator, steps), [&](Simulation& simulation) { simulation.advance(steps); });
}

Run run_tolerance(Device& device, const PrecisionCase& what, const Integrator& integrator, double tolerance) {
  return run_pliant(device, what, what.plan_tolerance(integrator, tolerance),
                    [&](Simulation& simulation) { simulation.advance_to(what.duration); });
}

Run run_peer(PeerSystem& system, const PrecisionCase& what, const PeerMethod& method, double effort) {
  std::vector<double> numbers = system.numbers_of(what.start.state);
  const std::uint64_t evaluations_before = system.evaluations();
  Run run;
  run.seconds = method.integrate(system, numbers, what.duration, effort);
  run.evaluations = system.evaluations() - evaluations_before;
  run.ending = ending_of(what.start.model, system.state_of(numbers, what.start.state));
  return run;
}

Reference find_reference(Device& device, const PrecisionCase& what) {
  const Integrator& integrator = find_integrator("vern8");
  const Run coarse = run_steps(device, what, integrator, what.reference_steps);
  Run fine = run_steps(device, what, integrator, 2 * what.reference_steps);
  const double error = relative_error(what, fine.ending, coarse.ending);
  return {std::move(fine.ending), error};
}

}  // namespace pliant::bench
