#include "bench/steps/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "bench/common/step_cases.hpp"
#include "bench/common/timing.hpp"
#include "bench/steps/trial.hpp"
#include "core/stopwatch.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

constexpr double longest_run = 60;       // [s]
constexpr double longest_quick_run = 1;  // [s]
constexpr double warming_time = 0.3;     // [s]; clocks rise under load
constexpr double enough_time = 1.5;      // for the runs of a case [s]; the last run may go beyond
constexpr double quick_time = 0.3;       // the same with `quick` [s]
constexpr int most_runs = 5;
constexpr int most_warming_runs = 30;  // bounds the time to build simulations of a scene with very short runs

struct Run {
  double seconds = 0;  // of the measured steps
  std::uint64_t contact_steps = 0;
};

// Reads nothing back while it measures steps.
class StepsRun {
 public:
  StepsRun(Device& device, const StepCase& what)
      : device_(device), simulation_(device, what.start.model, what.start.state, what.plan, what.collision) {}

  // Makes steps and returns their time [s].
  double make(std::uint64_t steps) {
    Stopwatch watch;
    watch.time([&] {
      simulation_.advance(steps);
      device_.finish();
    });
    return watch.seconds();
  }

  std::uint64_t contact_steps() { return simulation_.report().contact_steps; }

 private:
  Device& device_;
  Simulation simulation_;
};

Run run_once(Device& device, const StepCase& what) {
  StepsRun run(device, what);
  run.make(what.steps_before);
  const std::uint64_t contact_steps_before = run.contact_steps();
  const double seconds = run.make(what.steps);
  return {seconds, run.contact_steps() - contact_steps_before};
}

class StepsAt {
 public:
  explicit StepsAt(const Place& place) : place_(place), device_(open(place)) {}

  // Measures a case, or notes why it is left out.
  std::optional<StepsRow> measure(const StepCase& what, bool quick, std::vector<std::string>& notes) {
    build_kernels(what);
    StepsRun first(*device_, what);
    const Trial trial = try_steps(what.steps_before + what.steps, quick ? longest_quick_run : longest_run,
                                  [&](std::uint64_t steps) { return first.make(steps); });
    if (!trial.is_complete) {
      notes.push_back(reason(what, trial, quick));
      return {};
    }
    const double enough = quick ? quick_time : enough_time;
    if (what.steps_before == 0 && warmed_ >= warming_time && trial.seconds >= enough)  // the trial was a measurement
      return row(what, {trial.seconds, first.contact_steps()}, {trial.seconds});
    warmed_ += trial.seconds;
    return measure_runs(what, enough);
  }

 private:
  std::string reason(const StepCase& what, const Trial& trial, bool quick) const {
    const std::string beginning = fmt::format("{} on {}: left out", what.name, name_of(place_));
    if (quick) return fmt::format("{} of a quick measurement, as it takes over {:.0f} s", beginning, longest_quick_run);
    return fmt::format("{}, as it would take about {:.0f} s", beginning, trial.foreseen_seconds);
  }

  StepsRow measure_runs(const StepCase& what, double enough) {
    warm_up(what);
    std::vector<double> seconds;
    Run run;
    double passed = 0;
    do {
      run = run_once(*device_, what);
      passed += run.seconds;
      seconds.push_back(run.seconds);
    } while (passed < enough && static_cast<int>(seconds.size()) < most_runs);
    return row(what, run, seconds);
  }

  void warm_up(const StepCase& what) {
    for (int k = 0; k < most_warming_runs && warmed_ < warming_time; ++k) warmed_ += run_once(*device_, what).seconds;
  }

  // Makes a step, so that no measured one waits for kernels.
  void build_kernels(const StepCase& what) { StepsRun(*device_, what).make(1); }

  StepsRow row(const StepCase& what, const Run& run, const std::vector<double>& seconds) const {
    const auto steps = static_cast<double>(what.steps);
    return {.scene = what.name,
            .family = what.family,
            .device = place_.device,
            .precision = place_.precision,
            .threads = place_.threads,
            .vertices = what.start.model.vertex_count(),
            .bodies = static_cast<std::uint32_t>(what.start.model.bodies.size()),
            .clustered_bodies = clustered_bodies(what.start.model),
            .milliseconds_per_step = 1e3 * median(seconds) / steps,
            .fastest_milliseconds_per_step = 1e3 * std::ranges::min(seconds) / steps,
            .steps_per_second = steps / median(seconds),
            .steps = what.steps,
            .contact_steps = run.contact_steps,
            .runs = static_cast<int>(seconds.size())};
  }

  Place place_;
  std::unique_ptr<Device> device_;
  double warmed_ = 0;  // time of warming runs so far [s]
};

// With `quick` it drops the crossovers, because the last one may be beyond the small bodies.
StepsResult with_crossovers(StepsResult result, bool quick) {
  result.crossovers = find_crossovers(result.rows);
  if (!quick || result.crossovers.empty()) return result;
  result.crossovers.clear();
  result.notes.emplace_back("a quick measurement says nothing of where the GPU begins to lead");
  return result;
}

}  // namespace

StepsResult bench_steps(const StepsOptions& options, const Progress& progress) {
  constexpr int precisions[] = {32};
  StepCases all = load_step_cases(options.scenes, options.quick);
  StepsResult result{.rows = {}, .crossovers = {}, .notes = std::move(all.notes)};
  const std::vector<Place> places = places_of(options.devices, precisions);
  double done = 0;
  for (const Place& place : places) {
    StepsAt here(place);
    choose_force_sums(all, place.device);
    for (const StepCase& what : all.cases) {
      const double part = done++ / static_cast<double>(places.size() * all.cases.size());
      result.interrupted = !progress(part, fmt::format("{}, {}", name_of(place), what.name));
      if (result.interrupted) return with_crossovers(std::move(result), options.quick);
      if (auto row = here.measure(what, options.quick, result.notes)) result.rows.push_back(std::move(*row));
    }
  }
  progress(1, "");
  return with_crossovers(std::move(result), options.quick);
}

std::vector<FamilyCrossover> find_crossovers(const std::vector<StepsRow>& rows) {
  std::map<std::string, std::vector<SizedTime>> gpu;
  std::map<std::pair<std::string, unsigned>, std::vector<SizedTime>> cpu;
  for (const StepsRow& row : rows) {
    if (row.family.empty()) continue;
    auto& times = row.device == DeviceKind::gpu ? gpu[row.family] : cpu[{row.family, row.threads}];
    times.push_back({static_cast<double>(row.vertices), row.milliseconds_per_step});
  }
  std::vector<FamilyCrossover> crossovers;
  for (const auto& [key, times] : cpu)
    if (const auto found = gpu.find(key.first); found != gpu.end())
      crossovers.push_back({key.first, key.second, find_crossover(times, found->second)});
  return crossovers;
}

}  // namespace pliant::bench
