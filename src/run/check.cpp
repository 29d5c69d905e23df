#include "run/check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "model/deform.hpp"

namespace pliant {
namespace {

// Times a step with every body deformed, so that no force is skipped; a second one, unless that would take long, because the
// first also pays for what is done once.
double seconds_per_step(PreparedRun& run) {
  State deformed = run.start.state;
  swell(run.start.model, deformed, 1e-3);
  Simulation trial(*run.device, run.start.model, deformed, run.plan, run.scene.collision);
  const auto seconds_of_step = [&] {
    Stopwatch watch;
    watch.time([&] {
      trial.advance(1);
      run.device->finish();
    });
    return watch.seconds();
  };
  const double first = seconds_of_step();
  return first < 1 ? seconds_of_step() : first;
}

struct Estimate {
  double steps = 0, seconds = 0;
};

Estimate estimate_fixed(PreparedRun& run) {
  const auto steps = static_cast<double>(run.plan.steps);
  return {steps, steps * seconds_per_step(run)};
}

// Runs the scene for a second, at least one batch of steps, and takes the rest to be alike; no number where nothing came of it.
// Bodies that meet only later, or come to rest, are beyond it.
Estimate estimate_adaptive(PreparedRun& run) {
  Simulation trial(*run.device, run.start.model, run.start.state, run.plan, run.scene.collision);
  StepReport report = trial.report();
  Stopwatch watch;
  for (std::uint64_t frame = 1; watch.seconds() < 1 && report.time < run.plan.duration && !report.non_finite;) {
    const double target = run.plan.time_of_frame(frame).value_or(run.plan.duration);
    if (report.time < target)
      report = watch.time([&] { return trial.advance_toward(target); });
    else
      ++frame;
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  if (report.non_finite || (report.time == 0 && run.plan.duration > 0)) return {nothing, nothing};
  const double part = run.plan.duration > 0 ? report.time / run.plan.duration : 1;
  return {static_cast<double>(report.steps) / part, watch.seconds() / part};
}

std::string length_of_steps(const TimePlan& plan) {
  if (plan.tolerance) return fmt::format("by a tolerance of {:g}", *plan.tolerance);
  return fmt::format("{:.6g} s ({:.3g} of the bound)", plan.time_step, plan.time_step / plan.step_bound);
}

std::string count_of_steps(const TimePlan& plan, double count) {
  if (std::isnan(count)) return "unknown: no step of the trial stood, or it went non-finite";
  return fmt::format("{}{:.0f}", plan.tolerance ? "about " : "", count);
}

}  // namespace

void show_check(PreparedRun& run) {
  const Estimate estimate = run.plan.tolerance ? estimate_adaptive(run) : estimate_fixed(run);
  const std::size_t bytes = run.device->allocated_bytes();  // with what a first step has made the device take
  fmt::print("scene:            {}\n", run.scene.title.empty() ? run.scene.file.string() : run.scene.title);
  for (const ModelBody& body : run.start.model.bodies)
    fmt::print("body:             {} ({} vertices, {} triangles)\n", body.name, body.vertex_count, body.triangle_count);
  fmt::print("integrator:       {}\n", run.plan.integrator->name);
  fmt::print("stability bound:  {:.6g} s\n", run.plan.step_bound);
  fmt::print("time step:        {}\n", length_of_steps(run.plan));
  fmt::print("steps:            {}\n", count_of_steps(run.plan, estimate.steps));
  fmt::print("device:           {} ({})\n", run.device->info().kind, run.device->info().name);
  fmt::print("device memory:    {:.1f} MB\n", static_cast<double>(bytes) / 1e6);
  fmt::print("stepping time:    {}\n",
             std::isnan(estimate.seconds) ? "unknown" : fmt::format("about {:.3g} s", estimate.seconds));
}

}  // namespace pliant
