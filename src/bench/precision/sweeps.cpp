#include "bench/precision/sweeps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "bench/common/timing.hpp"
#include "core/stopwatch.hpp"
#include "dynamics/automatic_integrator.hpp"

namespace pliant::bench {
namespace {

constexpr double refinement = 2, contest_refinement = std::numbers::sqrt2;  // of fixed steps, from row to row
constexpr double all_tolerances[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
constexpr double tolerance_growth = 1.6;  // of the work from one tolerance to the next: 10^(1/5), for order 5 or more
constexpr double largest_error = 0.1;     // a run with a larger error failed
constexpr double most_doubled = 8;        // most steps tried by doubling, over the number of steps of 1 rad
constexpr double falling = 0.8;           // an error falls if it is below this part of the best before

bool is_of_contest(const Place& place) { return place.device == DeviceKind::cpu && place.precision == 64 && place.threads == 1; }

std::vector<const Integrator*> adaptive_methods(DampingLaw law, int precision) {
  std::vector<const Integrator*> methods{&find_integrator("dop853")};
  for (const double tolerance : all_tolerances) {
    const Integrator& automatic = automatic_integrator(tolerance, law);
    if (tolerance >= smallest_tolerance(automatic, precision) && std::ranges::find(methods, &automatic) == methods.end())
      methods.push_back(&automatic);
  }
  return methods;
}

}  // namespace

Sweeps::Sweeps(const PrecisionCase& what, Reference reference, const SweepLimits& limits, GoOn go_on)
    : what_(what), reference_(std::move(reference)), limits_(limits), go_on_(std::move(go_on)) {}

bool Sweeps::steps(Device& device, const Place& place) {
  for (const Integrator& integrator : integrators()) {
    if (!allows_damping(integrator, what_.damping_law)) continue;
    const auto run = [this, &device, &integrator](double steps) {
      return run_steps(device, what_, integrator, static_cast<std::uint64_t>(steps));
    };
    if (!shorten_steps(row_like(integrator, place), name_of(place), is_of_contest(place) ? contest_refinement : refinement, run))
      return false;
  }
  return true;
}

bool Sweeps::tolerances(Device& device, const Place& place) {
  for (const Integrator* integrator : adaptive_methods(what_.damping_law, place.precision)) {
    PrecisionRow like = row_like(*integrator, place);
    like.adaptive = true;
    const auto run = [this, &device, integrator](double tolerance) {
      return run_tolerance(device, what_, *integrator, tolerance);
    };
    if (!sharpen_tolerance(like, name_of(place), smallest_tolerance(*integrator, place.precision), run)) return false;
  }
  return true;
}

bool Sweeps::peers() {
  system_.emplace(what_.start.model, what_.damping_law, what_.omega);
  for (const PeerMethod& method : peer_methods(system_->is_damped())) {
    const PrecisionRow like{
        .case_name = what_.name, .library = method.library, .method = method.name, .adaptive = method.adaptive};
    const auto run = [this, method](double effort) { return run_peer(*system_, what_, method, effort); };
    const bool on = method.adaptive ? sharpen_tolerance(like, method.library, 0, run)
                                    : shorten_steps(like, method.library, contest_refinement, run);
    if (!on) return false;
  }
  return true;
}

bool Sweeps::repeat() {
  for (int round = 2; round <= limits_.rounds; ++round)
    for (Measured& one : measured_) {
      if (!go_on_(fmt::format("{}, round {} of {}", what_.name, round, limits_.rounds))) return false;
      one.seconds.push_back(one.run_at(one.effort).seconds);
    }
  return true;
}

double Sweeps::seconds_of_rates() {
  std::vector<double> numbers = system_->numbers_of(what_.start.state), rates(numbers.size());
  return seconds_each(quick_effort,
                      [&](std::uint64_t repetitions) {
                        Stopwatch watch;
                        watch.time([&] {
                          for (std::uint64_t k = 0; k < repetitions; ++k) system_->rates(numbers.data(), rates.data());
                        });
                        return watch.seconds();
                      })
      .fastest;
}

std::vector<PrecisionRow> Sweeps::rows() const {
  std::vector<PrecisionRow> rows;
  for (const Measured& one : measured_) {
    rows.push_back(one.row);
    rows.back().seconds = median(one.seconds);
    rows.back().fastest_seconds = std::ranges::min(one.seconds);
    rows.back().runs = static_cast<int>(one.seconds.size());
  }
  return rows;
}

PrecisionRow Sweeps::row_like(const Integrator& integrator, const Place& place) const {
  return {.case_name = what_.name,
          .library = "pliant",
          .method = std::string(integrator.name),
          .device = place.device,
          .precision = place.precision,
          .threads = place.threads};
}

bool Sweeps::goes_on(const std::string& where, const PrecisionRow& like) const {
  return go_on_(fmt::format("{}, {}, {}{}", what_.name, where, like.method, like.adaptive ? " (adaptive)" : ""));
}

bool Sweeps::may_go_on(const Trend& trend) const {
  return trend.without_progress < 2 && trend.next_seconds <= limits_.longest_run &&
         trend.next_evaluations <= limits_.most_evaluations;
}

// Returns the fewest steps with which a method is stable enough to end near the truth. Begins with steps of 1 rad, doubles or
// halves their number, and then bisects.
double Sweeps::fewest_steps(const RunAt& run) const {
  const auto serves = [&](double steps) { return relative_error(what_, reference_.ending, run(steps).ending) < largest_error; };
  const double first = std::ceil(what_.omega * what_.duration);
  double enough = first;
  while (!serves(enough) && enough < most_doubled * first) enough *= 2;
  double too_few = std::floor(enough / 2);
  for (; enough <= first && too_few > 0 && serves(too_few); too_few = std::floor(too_few / 2)) enough = too_few;
  while (enough - too_few > 1) {
    const double middle = std::floor((enough + too_few) / 2);
    (serves(middle) ? enough : too_few) = middle;
  }
  return enough;
}

bool Sweeps::shorten_steps(PrecisionRow like, const std::string& where, double factor, const RunAt& run) {
  if (!goes_on(where, like)) return false;
  Trend trend;
  for (double wanted = fewest_steps(run); may_go_on(trend); wanted *= factor) {
    const double steps = std::round(wanted);
    like.step = what_.omega * what_.duration / steps;
    if (!goes_on(where, like)) return false;
    measure(like, steps, run, factor, trend);
  }
  return true;
}

bool Sweeps::sharpen_tolerance(PrecisionRow like, const std::string& where, double smallest, const RunAt& run) {
  if (!goes_on(where, like)) return false;
  static_cast<void>(run(all_tolerances[0]));  // builds the kernels
  Trend trend;
  for (const double tolerance : all_tolerances) {
    if (tolerance < smallest || !may_go_on(trend)) break;
    like.tolerance = tolerance;
    if (!goes_on(where, like)) return false;
    measure(like, tolerance, run, tolerance_growth, trend);
  }
  return true;
}

void Sweeps::measure(PrecisionRow row, double effort, const RunAt& run_at, double growth, Trend& trend) {
  const Run run = run_at(effort);
  row.evaluations = run.evaluations;
  row.contact_steps = run.contact_steps;
  row.error = relative_error(what_, reference_.ending, run.ending);
  const bool worked_more = run.evaluations > trend.evaluations;  // false if stability alone bounds the steps
  trend.evaluations = run.evaluations;
  trend.next_seconds = growth * run.seconds;
  trend.next_evaluations = growth * static_cast<double>(run.evaluations);
  if (!(row.error < largest_error)) return;
  if (row.error < falling * trend.best_error)
    trend.without_progress = 0;
  else if (worked_more)
    ++trend.without_progress;
  trend.best_error = std::min(trend.best_error, row.error);
  if (row.error <= reference_.error) trend.without_progress = 2;  // a smaller error can't be measured
  measured_.push_back({std::move(row), run_at, effort, {run.seconds}});
}

}  // namespace pliant::bench
