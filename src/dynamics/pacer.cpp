// See pacer.hpp. The controller itself is physics/pace.glsl.
#include "dynamics/pacer.hpp"

#include <algorithm>
#include <cstddef>

#include "core/expect.hpp"
#include "dynamics/stability.hpp"
#include "model/mean_edge.hpp"

namespace pliant {
namespace {

constexpr double unbounded = 1e30;  // [s] or [m]

// This is measured: with 3 / 8 three_spheres ends tangled at most tolerances, with 1 / 4 no scene does.
constexpr double contact_motion_per_edge = 0.25;

std::vector<double> error_scales(const Model& model, DampingLaw law) {
  std::vector<double> scales;
  for (const ModelBody& body : model.bodies) {
    const double radius = body.radius > 0 ? body.radius : body.unit_of_length();
    const double rate = std::max(stiffest_frequency(body), largest_damping_rate(body, law));
    scales.push_back(1 / radius);
    scales.push_back(rate > 0 ? 1 / (radius * rate) : 0);  // without springs and damping there is no error
  }
  return scales;
}

double largest_contact_motion(const Model& model) {
  double edge = unbounded;
  for (const ModelBody& body : model.bodies)
    if (body.triangle_count > 0) edge = std::min(edge, mean_edge(model, body));
  return contact_motion_per_edge * edge;
}

physics::Pace first_pace(const Model& model, const StagedMethod& method, const PaceLimits& limits) {
  PLIANT_EXPECT(limits.tolerance > 0 && limits.first_step > 0 && limits.largest_step > 0);
  physics::Pace pace{};
  pace.end = limits.end;
  pace.tolerance = limits.tolerance;
  pace.largest_step = std::min(limits.largest_step, unbounded);
  pace.first_step = std::min(limits.first_step, pace.largest_step);
  pace.estimate_order = static_cast<std::uint32_t>(estimate_order(method));
  pace.allowed = pace.first_step;
  pace.largest_motion = largest_contact_motion(model);
  pace.error_before = physics::aimed_error();
  physics::forget_step(pace);
  return pace;
}

}  // namespace

std::uint64_t steps_toward(double target, const physics::Pace& pace, std::uint64_t most) {
  const bool is_new = pace.allowed <= pace.first_step;
  const double longest = std::max(pace.allowed, pace.accepted == 0 ? pace.largest_step : pace.largest_taken);
  double left = target - pace.time, step = pace.allowed;
  std::uint64_t steps = 0;
  for (; left > 0 && steps < most; ++steps) {
    left -= physics::fitted_step(step, left);
    if (is_new) step = std::min(step * physics::largest_growth(), longest);
  }
  return steps;
}

Pacer::Pacer(DeviceBodies& bodies, const Model& model, const Stepper& stepper, const Integrator& integrator, DampingLaw law,
             const PaceLimits& limits)
    : bodies_(bodies), stage_count_(stepper.stage_count()) {
  PLIANT_EXPECT(estimates_error(integrator));
  const std::vector<double> weights = error_weights(integrator);
  PLIANT_EXPECT(weights.size() == std::size_t{4} * stepper.stage_count());
  bodies.arrays.make("pace", std::vector{first_pace(model, *staged_method(integrator), limits)});
  bodies.arrays.make("error_weight", weights);
  bodies.arrays.make("error_scale", error_scales(model, law));
}

void Pacer::aim_at(double time) {
  const Arrays& arrays = bodies_.arrays;
  arrays.device().write(arrays.buffer("pace"), offsetof(physics::Pace, target), std::as_bytes(std::span(&time, 1)));
}

physics::Pace Pacer::pace() const { return bodies_.arrays.get<physics::Pace>("pace").download().front(); }

Pass Pacer::beginning_pass() const { return make_pass(bodies_.arrays, "begin_step", {}, bodies_.body_count); }

Pass Pacer::estimating_pass() const {
  return make_pass(bodies_.arrays, "estimate_error", {{"stage_count", stage_count_}}, bodies_.vertex_count);
}

Pass Pacer::contact_pass(std::uint32_t from_half) const {
  return make_pass(bodies_.arrays, "measure_contact", {{"from_half", from_half}}, bodies_.vertex_count);
}

std::vector<Pass> Pacer::judging_passes(std::uint32_t from_half) const {
  return {make_pass(bodies_.arrays, "judge_step", {}, 1),
          make_pass(bodies_.arrays, "undo_step", {{"from_half", from_half}}, bodies_.vertex_count)};
}

}  // namespace pliant
