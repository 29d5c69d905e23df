#include "run/step_cost.hpp"

#include <fmt/format.h>

#include <chrono>
#include <tuple>
#include <utility>
#include <vector>

#include "device/cpu/cpu_device.hpp"
#include "mesh/generators.hpp"
#include "model/deform.hpp"

namespace pliant {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double few_pairs = 1e7;              // sum of N (N - 1) over all bodies: 0.1 s a step on a CPU
constexpr double longest_springs_tried = 0.5;  // of a step [s]
constexpr double shortest_calibration = 0.02;  // of a step [s]; on a GPU shorter steps have other rates
constexpr std::chrono::seconds longest_trial{1};
constexpr int coarsest = 3, finest = 7;  // spheres of 642 to 163,842 vertices

// Of springs that are summed one by one.
double pair_count(const Model& model) {
  double pairs = 0;
  for (const ModelBody& body : model.bodies)
    if (!body.is_rigid() && !body.is_clustered) pairs += static_cast<double>(body.vertex_count) * (body.vertex_count - 1.0);
  return pairs;
}

// Deforms every body, so that no force is skipped.
State deformed(const ModelAndState& start) {
  State state = start.state;
  swell(start.model, state, 1e-3);
  return state;
}

// Times a second step, unless that would take long, because the first also pays for what is done once. A step that falls into
// many parts is left after a second, and the rest of it is taken to be like the part that was made.
double seconds_of_step(Device& device, const ModelAndState& start, TimePlan plan, const CollisionDescription& collision) {
  plan.tolerance.reset();
  Simulation trial(device, start.model, deformed(start), plan, collision);
  const auto timed_step = [&] {
    const double before = trial.report().time;
    Stopwatch watch;
    watch.time([&] {
      const auto end = Clock::now() + longest_trial;
      trial.advance(1, [end] { return Clock::now() > end; });
      device.finish();
    });
    return std::pair(watch.seconds(), (trial.report().time - before) / plan.time_step);
  };
  auto [seconds, part] = timed_step();
  if (seconds < 1 || part < 0.5) std::tie(seconds, part) = timed_step();
  return part > 0 ? seconds / part : seconds;
}

ModelAndState sphere(int level) {
  BodySetup setup;
  setup.description.name = "sphere";
  setup.mesh = generate_mesh(fmt::format("icosphere:{}", level));
  return build_model({&setup, 1}, glm::dvec3(0.0));
}

double seconds_by_springs(const PreparedRun& run) {
  const bool is_cpu = run.device->info().kind == DeviceKind::cpu;
  const auto own = is_cpu ? make_cpu_device(run.device->info().threads, run.device->precision()) : nullptr;
  TimePlan plan = run.plan;
  plan.time_step = 1e-6;  // stable for every sphere
  for (int level = coarsest;; ++level) {
    const ModelAndState start = sphere(level);
    const double seconds = seconds_of_step(own ? *own : *run.device, start, plan, {});
    if (seconds > shortest_calibration || level == finest) return seconds * pair_count(run.start.model) / pair_count(start.model);
  }
}

}  // namespace

double seconds_per_step(const PreparedRun& run) {
  if (pair_count(run.start.model) > few_pairs) {
    const double springs = seconds_by_springs(run);
    if (springs > longest_springs_tried) return springs;
  }
  return seconds_of_step(*run.device, run.start, run.plan, run.scene.collision);
}

std::size_t bytes_of_run(const PreparedRun& run) {
  std::size_t bytes = run.device->allocated_bytes();
  if (run.device->info().kind != DeviceKind::cpu) return bytes;
  std::vector<std::uint32_t> vertex_counts;
  for (const ModelBody& body : run.start.model.bodies)
    if (!body.is_rigid() && !body.is_clustered) vertex_counts.push_back(body.vertex_count);
  return bytes + cpu::spring_scratch_bytes(vertex_counts, run.device->precision());
}

}  // namespace pliant
