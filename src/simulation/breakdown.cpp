#include "simulation/breakdown.hpp"

#include <fmt/format.h>

namespace pliant {
namespace {

// A step of such a body goes non-finite if its volume comes to zero or below, or if no springs hold the pressure. What is left of
// the state does not tell whether it did.
bool may_have_lost_its_volume(const ModelBody& body) { return body.inflation.pressure > 0; }

std::string remedy(const TimePlan& plan, const ModelBody& body) {
  if (may_have_lost_its_volume(body) && plan.tolerance)
    return "lower its pressure or velocities, stiffen its springs, or loosen the tolerance";
  if (may_have_lost_its_volume(body) && plan.time_step <= plan.step_bound)
    return "shorten the time step, lower its pressure or velocities, or stiffen its springs";
  if (plan.tolerance) return "loosen the tolerance, or lower stiffness, damping or velocities";
  if (plan.time_step > plan.step_bound) return fmt::format("shorten the time step to {:.4g} s or less", plan.step_bound);
  return "shorten the time step, or lower stiffness, damping or velocities";
}

std::string reason(const Breakdown& where, const TimePlan& plan) {
  if (where.failed_step == 0) return "the simulation became non-finite";
  if (where.takes_too_many)
    return fmt::format("the run would exceed 3e8 steps, because the tolerance of {:g} needs steps as short as {:.3g} s,",
                       *plan.tolerance, where.failed_step);
  return fmt::format("no step down to {:.3g} s meets the tolerance of {:g}", where.failed_step, *plan.tolerance);
}

}  // namespace

std::string describe_breakdown(const Breakdown& where, const TimePlan& plan, const Model& model) {
  const ModelBody& body = model.bodies[where.body];
  return fmt::format("{} in step {} at vertex {} of body \"{}\"{}; {}", reason(where, plan), where.step, where.vertex, body.name,
                     may_have_lost_its_volume(body) ? ", whose volume may have come to zero or grown without end" : "",
                     remedy(plan, body));
}

}  // namespace pliant
