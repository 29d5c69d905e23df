// The automatic step keeps a tenth away from the stability bound of the stiffest body.
#include "simulation/time_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "dynamics/stability.hpp"

namespace pliant {
namespace {

constexpr double safety = 0.9;
constexpr double largest_step_count = 3e8;  // counts of forces on the device have 32 bits

double largest_damping_rate(const ModelBody& body, DampingLaw law) {
  if (law == DampingLaw::none) return 0;
  return (law == DampingLaw::adaptive ? 10.0 : 1.0) * body.damping / body.vertex_mass;
}

double bound_of(const Integrator& integrator, const ModelBody& body, DampingLaw law) {
  const double rate = largest_damping_rate(body, law);
  const double stiffest = body.vertex_count * body.stiffness / body.vertex_mass;
  // The stiffest mode, and the body's own translation, which springs do not hold back.
  return std::min(step_bound(integrator, stiffest, rate), step_bound(integrator, 0, rate));
}

double automatic_step(double bound, double frame_rate) {
  const double frame_time = 1 / frame_rate;
  if (!std::isfinite(bound)) return frame_time;
  return frame_time / std::max(1.0, std::ceil(frame_time / (safety * bound) - 1e-9));
}

DampingLaw effective_law(DampingLaw law, const Model& model) {
  const bool damped = std::ranges::any_of(model.bodies, [](const ModelBody& body) { return body.damping > 0; });
  return damped ? law : DampingLaw::none;
}

void expect_method_damps(const TimePlan& plan, const std::string& where) {
  if (plan.damping_law == DampingLaw::none || allows_damping(*plan.integrator)) return;
  throw Error(fault_of(where), where,
              std::string(plan.integrator->name) + " has kicks back in time, which damping makes unstable",
              "set simulation.damping_law = \"none\" or choose another integrator, such as verlet");
}

std::uint64_t count_steps(const SceneDescription& scene, double time_step) {
  const double count = std::round(scene.simulation.duration / time_step);
  const std::string& where = scene.simulation.length_where;
  if (!(count <= largest_step_count))
    throw Error(fault_of(where), where.empty() ? scene.file.string() : where, "the run takes more than 3e8 steps",
                "shorten the duration or lengthen the time step");
  return static_cast<std::uint64_t>(count);
}

}  // namespace

std::uint64_t TimePlan::step_of_frame(std::uint64_t frame) const {
  constexpr double rounding = 1e-12;  // relative: a frame on a step, but for the quotient's last digits, takes that step
  const double step = static_cast<double>(frame) / (frame_rate * time_step);
  return static_cast<std::uint64_t>(std::min(std::ceil(step * (1 - rounding)), 1e18));
}

TimePlan plan_time(const SceneDescription& scene, const Model& model, std::optional<std::uint64_t> steps) {
  const SimulationDescription& simulation = scene.simulation;
  TimePlan plan{.integrator = &find_integrator(simulation.integrator.value, simulation.integrator.where),
                .step_bound = std::numeric_limits<double>::infinity(),
                .frame_rate = scene.output.frame_rate};
  plan.damping_law = effective_law(simulation.damping_law, model);
  expect_method_damps(plan, simulation.integrator.where);
  for (const ModelBody& body : model.bodies)
    plan.step_bound = std::min(plan.step_bound, bound_of(*plan.integrator, body, plan.damping_law));
  plan.time_step = simulation.time_step.value_or(automatic_step(plan.step_bound, plan.frame_rate));
  plan.steps = steps ? *steps : count_steps(scene, plan.time_step);
  return plan;
}

}  // namespace pliant
