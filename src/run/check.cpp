#include "run/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "dynamics/clusters/force_sums.hpp"
#include "run/step_cost.hpp"

namespace pliant {
namespace {

constexpr double longest_tried = 1;  // longest step that a trial with a tolerance makes [s of wall time]

struct Estimate {
  double steps = 0, seconds = 0;  // NaN if no step of the trial stood or it broke down
  bool is_least = false;          // a lower bound, because a trial would take long
};

Estimate estimate_fixed(const PreparedRun& run) {
  const auto steps = static_cast<double>(run.plan.steps);
  return {steps, steps * seconds_per_step(run)};
}

Estimate least_of_adaptive(const PreparedRun& run, double step_seconds) {
  const double longest = std::min(run.plan.step_bound, 1 / run.plan.frame_rate);
  const double steps = std::ceil(run.plan.duration / longest);
  return {steps, steps * step_seconds, true};
}

// Runs the scene for a second, or for one step if that is longer, and assumes that the rest costs the same. It can't foresee that
// bodies meet later or come to rest.
Estimate estimate_adaptive(const PreparedRun& run) {
  const double step_seconds = seconds_per_step(run);
  if (step_seconds > longest_tried) return least_of_adaptive(run, step_seconds);
  const auto batch = static_cast<std::uint64_t>(std::clamp(0.2 / step_seconds, 1.0, double{Simulation::most_steps_at_once}));
  Simulation trial(*run.device, run.start.model, run.start.state, run.plan, run.scene.collision);
  StepReport report = trial.report();
  Stopwatch watch;
  for (std::uint64_t frame = 1; watch.seconds() < 1 && report.time < run.plan.duration && !report.breakdown;) {
    const double target = run.plan.time_of_frame(frame).value_or(run.plan.duration);
    if (report.time < target)
      report = watch.time([&] { return trial.advance_toward(target, batch); });
    else
      ++frame;
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  if (report.breakdown || (report.time == 0 && run.plan.duration > 0)) return {nothing, nothing};
  const double part = run.plan.duration > 0 ? report.time / run.plan.duration : 1;
  return {static_cast<double>(report.steps) / part, watch.seconds() / part};
}

std::string length_of_steps(const TimePlan& plan) {
  if (plan.tolerance) return fmt::format("by a tolerance of {:g}", *plan.tolerance);
  return fmt::format("{:.6g} s ({:.3g} of the bound)", plan.time_step, plan.time_step / plan.step_bound);
}

std::string count_of_steps(const TimePlan& plan, const Estimate& estimate) {
  if (std::isnan(estimate.steps)) return "unknown: the trial rejected every step, or became non-finite";
  return fmt::format("{}{:.0f}", estimate.is_least ? "at least " : plan.tolerance ? "about " : "", estimate.steps);
}

std::string time_of_steps(const Estimate& estimate) {
  if (std::isnan(estimate.seconds)) return "unknown";
  return fmt::format("{} {:.3g} s, and more once bodies meet", estimate.is_least ? "at least" : "about", estimate.seconds);
}

std::string sums_of(const ModelBody& body) {
  constexpr std::uint32_t dense = 10'000;  // vertices, from where on clusters take a third of the time or less
  if (body.is_clustered) return fmt::format(", springs by clusters to {:.3g}", force_tolerance_of(body));
  if (body.is_rigid() || body.forces != ForceSum::automatic) return "";
  if (body.force_tolerance) return ", springs one by one: too few vertices for its force_tolerance";
  if (body.vertex_count < dense) return "";
  const double vertices = body.vertex_count;
  return fmt::format(", {:.0f} million springs, which force_tolerance = 1e-3 would sum by clusters",
                     1e-6 * vertices * (vertices - 1) / 2);
}

// Bodies in rows that have equally many vertices and triangles share a line.
void show_bodies(std::span<const ModelBody> bodies) {
  for (auto first = bodies.begin(); first != bodies.end();) {
    const auto next = std::find_if(first, bodies.end(), [&](const ModelBody& body) {
      return body.name_of_rows() != first->name_of_rows() || body.vertex_count != first->vertex_count ||
             body.triangle_count != first->triangle_count || sums_of(body) != sums_of(*first);
    });
    const auto count = next - first;
    const std::string size =
        fmt::format("{} vertices, {} triangles{}", first->vertex_count, first->triangle_count, sums_of(*first));
    if (count == 1)
      fmt::print("body:             {} ({})\n", first->name, size);
    else
      fmt::print("bodies:           {}, {} to {} ({} each)\n", count, first->name, (next - 1)->name, size);
    first = next;
  }
}

}  // namespace

void show_check(const PreparedRun& run) {
  const std::size_t bytes = bytes_of_run(run);
  const Estimate estimate = run.plan.tolerance ? estimate_adaptive(run) : estimate_fixed(run);
  fmt::print("scene:            {}\n", run.scene.title.empty() ? run.scene.file.string() : run.scene.title);
  show_bodies(run.start.model.bodies);
  fmt::print("response:         {}\n", run.scene.collision.response.value);
  fmt::print("damping law:      {}\n", name_of(run.plan.damping_law));
  fmt::print("integrator:       {}\n", run.plan.integrator->name);
  fmt::print("stability bound:  {:.6g} s\n", run.plan.step_bound);
  fmt::print("time step:        {}\n", length_of_steps(run.plan));
  fmt::print("steps:            {}\n", count_of_steps(run.plan, estimate));
  fmt::print("device:           {} ({})\n", name_of(run.device->info().kind), run.device->info().name);
  const std::uint64_t free_memory = run.device->info().free_memory;
  fmt::print("device memory:    {:.1f} MB{}\n", 1e-6 * static_cast<double>(bytes),
             free_memory == 0 ? "" : fmt::format(", of {:.0f} MB that are free", 1e-6 * static_cast<double>(free_memory)));
  fmt::print("stepping time:    {}\n", time_of_steps(estimate));
}

}  // namespace pliant
