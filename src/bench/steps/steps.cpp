#include "bench/steps/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "bench/common/step_cases.hpp"
#include "bench/common/timing.hpp"
#include "core/stopwatch.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

constexpr double longest_run = 60;       // [s]
constexpr double warming_time = 0.3;     // [s]; clocks rise under load
constexpr double enough_time = 1.5;      // for the runs of a case [s]; the last run may go beyond
constexpr double quick_time = 0.3;       // the same with `quick` [s]
constexpr double longest_quick_run = 1;  // [s]
constexpr double telling_step = 1e-3;    // springs take most of a step as long as this, and not overhead [s]
constexpr int most_runs = 5;
constexpr int most_warming_runs = 30;  // bounds the time to build simulations of a scene with very short runs

struct Run {
  double seconds = 0;  // of the measured steps
  std::uint64_t contact_steps = 0, pair_interactions = 0;
};

// Reads nothing back while it measures steps.
Run run_once(Device& device, const StepCase& what) {
  Simulation simulation(device, what.start.model, what.start.state, what.plan, what.collision);
  simulation.advance(what.steps_before);
  const StepReport before = simulation.report();
  Stopwatch watch;
  watch.time([&] {
    simulation.advance(what.steps);
    device.finish();
  });
  const StepReport after = simulation.report();
  return {watch.seconds(), after.contact_steps - before.contact_steps, after.pair_interactions - before.pair_interactions};
}

double pair_interactions_of_step(const StepCase& what) {
  double pairs = 0;
  for (const ModelBody& body : what.start.model.bodies) pairs += static_cast<double>(body.vertex_count) * body.vertex_count;
  return pairs * evaluations_per_step(*what.plan.integrator);
}

class StepsAt {
 public:
  explicit StepsAt(const Place& place) : place_(place), device_(open(place)) {}

  // Returns the expected time of one run without skipped forces [s], or 0 if no case so far had steps of telling_step or more.
  double expected_seconds(const StepCase& what) const {
    return seconds_per_pair_ * pair_interactions_of_step(what) * static_cast<double>(what.steps_before + what.steps);
  }

  // Returns whether a cold run of the case takes a second at most, as `quick` needs. Stops after that second.
  bool is_short(const StepCase& what) {
    build_kernels(what);
    Simulation simulation(*device_, what.start.model, what.start.state, what.plan, what.collision);
    const std::uint64_t steps = what.steps_before + what.steps;
    Stopwatch watch;
    for (std::uint64_t made = 0; made < steps;) {
      const std::uint64_t batch = std::min({made + 1, steps - made, Simulation::most_steps_at_once});
      watch.time([&] {
        simulation.advance(batch);
        device_->finish();
      });
      made += batch;
      if (made < steps && watch.seconds() > longest_quick_run) return false;
    }
    return true;
  }

  StepsRow measure(const StepCase& what, bool quick) {
    build_kernels(what);
    warm_up(what);
    std::vector<double> seconds;
    Run run;
    double passed = 0;
    do {
      run = run_once(*device_, what);
      passed += run.seconds;
      seconds.push_back(run.seconds);
    } while (passed < (quick ? quick_time : enough_time) && static_cast<int>(seconds.size()) < most_runs);
    learn(median(seconds), static_cast<double>(what.steps), static_cast<double>(run.pair_interactions));
    return row(what, run, seconds);
  }

 private:
  void warm_up(const StepCase& what) {
    for (int k = 0; k < most_warming_runs && warmed_ < warming_time; ++k) warmed_ += run_once(*device_, what).seconds;
  }

  // Makes a step, so that no measured one waits for kernels.
  void build_kernels(const StepCase& what) {
    Simulation(*device_, what.start.model, what.start.state, what.plan, what.collision).advance(1);
    device_->finish();
  }

  // Takes the least time of a pair, because overhead only adds to it.
  void learn(double seconds, double steps, double pairs) {
    if (pairs == 0 || seconds < telling_step * steps) return;
    seconds_per_pair_ = seconds_per_pair_ == 0 ? seconds / pairs : std::min(seconds_per_pair_, seconds / pairs);
  }

  StepsRow row(const StepCase& what, const Run& run, const std::vector<double>& seconds) const {
    const auto steps = static_cast<double>(what.steps);
    return {.scene = what.name,
            .family = what.family,
            .device = place_.device,
            .precision = place_.precision,
            .threads = place_.threads,
            .vertices = what.start.model.vertex_count(),
            .bodies = static_cast<std::uint32_t>(what.start.model.bodies.size()),
            .milliseconds_per_step = 1e3 * median(seconds) / steps,
            .fastest_milliseconds_per_step = 1e3 * std::ranges::min(seconds) / steps,
            .steps_per_second = steps / median(seconds),
            .steps = what.steps,
            .contact_steps = run.contact_steps,
            .runs = static_cast<int>(seconds.size())};
  }

  Place place_;
  std::unique_ptr<Device> device_;
  double warmed_ = 0;            // time of warming runs so far [s]
  double seconds_per_pair_ = 0;  // 0: unknown
};

// With `quick` it drops the crossovers, because the last one may be beyond the small bodies.
StepsResult with_crossovers(StepsResult result, bool quick) {
  result.crossovers = find_crossovers(result.rows);
  if (!quick || result.crossovers.empty()) return result;
  result.crossovers.clear();
  result.notes.emplace_back("a quick measurement says nothing of where the GPU begins to lead");
  return result;
}

std::optional<StepsRow> measured_or_noted(StepsAt& place, const std::string& place_name, const StepCase& what, bool quick,
                                          std::vector<std::string>& notes) {
  const double expected = place.expected_seconds(what);
  if (expected > longest_run)
    notes.push_back(fmt::format("{} on {}: left out, as it would take about {:.0f} s", what.name, place_name, expected));
  else if (quick && !place.is_short(what))
    notes.push_back(fmt::format("{} on {}: left out of a quick measurement, as it takes over {:.0f} s", what.name, place_name,
                                longest_quick_run));
  else
    return place.measure(what, quick);
  return {};
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
    for (const StepCase& what : all.cases) {
      const double part = done++ / static_cast<double>(places.size() * all.cases.size());
      result.interrupted = !progress(part, fmt::format("{}, {}", name_of(place), what.name));
      if (result.interrupted) return with_crossovers(std::move(result), options.quick);
      if (auto row = measured_or_noted(here, name_of(place), what, options.quick, result.notes))
        result.rows.push_back(std::move(*row));
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
