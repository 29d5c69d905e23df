#include "bench/precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "bench/peers.hpp"
#include "bench/precision_cases.hpp"
#include "bench/timing.hpp"
#include "core/stopwatch.hpp"
#include "simulation/simulation.hpp"

namespace pliant::bench {
namespace {

struct Limits {
  double longest_run;  // [s]
  double most_evaluations;
  double sharpening;  // of tolerances, from row to row
  int rounds;
};
constexpr Limits full_limits{.longest_run = 1.5, .most_evaluations = 4000, .sharpening = 10, .rounds = 3};
constexpr Limits quick_limits{.longest_run = 0.06, .most_evaluations = 1200, .sharpening = 10, .rounds = 3};
constexpr double loosest_tolerance = 1e-2, tightest_tolerance = 1e-14;
constexpr double refinement = 2, contest_refinement = std::numbers::sqrt2;  // of fixed steps, from row to row
constexpr double largest_error = 0.1;                                       // that says more than that a run failed
constexpr double most_doubled = 8;                                          // times steps of 1 rad
constexpr double falling = 0.8;  // an error above so much of the best before does not fall

struct Run {
  double seconds = 0;
  std::uint64_t evaluations = 0, contact_steps = 0;
  Ending ending;
};

Run run_once(Device& device, const PrecisionCase& what, const Integrator& integrator, std::uint64_t steps) {
  Simulation simulation(device, what.start.model, what.start.state, what.plan(integrator, steps), what.collision);
  device.finish();
  Stopwatch watch;
  watch.time([&] {
    simulation.advance(steps);
    device.finish();
  });
  const StepReport report = simulation.report();
  return {watch.seconds(), (report.force_evaluations + report.forces_skipped) / what.start.model.bodies.size(),
          report.contact_steps, ending_of(what.start.model, simulation.state())};
}

Run run_once(PeerSystem& system, const PrecisionCase& what, const PeerMethod& method, double effort) {
  std::vector<double> numbers = system.numbers_of(what.start.state);
  const std::uint64_t evaluations_before = system.evaluations();
  Run run;
  run.seconds = method.integrate(system, numbers, what.duration, effort);
  run.evaluations = system.evaluations() - evaluations_before;
  run.ending = ending_of(what.start.model, system.state_of(numbers, what.start.state));
  return run;
}

struct Reference {
  Ending ending;
  double error = 0;
};

Reference find_reference(Device& device, const PrecisionCase& what) {
  const Integrator& integrator = find_integrator("vern8");
  const Run coarse = run_once(device, what, integrator, what.reference_steps);
  Run fine = run_once(device, what, integrator, 2 * what.reference_steps);
  const double error = relative_error(what, fine.ending, coarse.ending);
  return {std::move(fine.ending), error};
}

PrecisionCaseInfo info_of(const PrecisionCase& what, double reference_error) {
  return {.name = what.name,
          .vertices = what.start.model.vertex_count(),
          .bodies = static_cast<std::uint32_t>(what.start.model.bodies.size()),
          .damping_law = name_of(what.damping_law),
          .duration = what.duration,
          .omega = what.omega,
          .reference_step = what.omega * what.duration / (2.0 * static_cast<double>(what.reference_steps)),
          .reference_error = reference_error,
          .is_contest = what.is_contest};
}

// One case: sweeps over efforts, that is numbers of steps or tolerances, make rows. All are then run again in rounds, so that a
// bad moment of the machine meets one run of a row, not all.
class Sweeps {
 public:
  using RunAt = std::function<Run(double effort)>;

  Sweeps(const PrecisionCase& what, Reference reference, const Limits& limits, std::function<bool(std::string_view)> go_on)
      : what_(what), reference_(std::move(reference)), limits_(limits), go_on_(std::move(go_on)) {}

  /// False where the suite ends.
  bool pliant(Device& device, const Place& place) {
    for (const Integrator& integrator : integrators()) {
      if (!allows_damping(integrator, what_.damping_law)) continue;
      const PrecisionRow like{.case_name = what_.name,
                              .library = "pliant",
                              .method = std::string(integrator.name),
                              .device = place.device,
                              .precision = place.precision,
                              .threads = place.threads};
      const auto run = [this, &device, &integrator](double steps) {
        return run_once(device, what_, integrator, static_cast<std::uint64_t>(steps));
      };
      if (!shorten_steps(like, name_of(place), is_of_contest(place) ? contest_refinement : refinement, run)) return false;
    }
    return true;
  }

  bool peers() {
    system_.emplace(what_.start.model, what_.damping_law, what_.omega);
    for (const PeerMethod& method : peer_methods(system_->is_damped())) {
      const PrecisionRow like{
          .case_name = what_.name, .library = method.library, .method = method.name, .adaptive = method.adaptive};
      const auto run = [this, method](double effort) { return run_once(*system_, what_, method, effort); };
      const bool on =
          method.adaptive ? sharpen_tolerance(like, run) : shorten_steps(like, method.library, contest_refinement, run);
      if (!on) return false;
    }
    return true;
  }

  double seconds_of_rates() {
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

  bool repeat() {
    for (int round = 2; round <= limits_.rounds; ++round)
      for (Measured& one : measured_) {
        if (!go_on_(fmt::format("{}, round {} of {}", what_.name, round, limits_.rounds))) return false;
        one.seconds.push_back(one.run_at(one.effort).seconds);
      }
    return true;
  }

  [[nodiscard]] std::vector<PrecisionRow> rows() const {
    std::vector<PrecisionRow> rows;
    for (const Measured& one : measured_) {
      rows.push_back(one.row);
      rows.back().seconds = median(one.seconds);
      rows.back().fastest_seconds = std::ranges::min(one.seconds);
      rows.back().runs = static_cast<int>(one.seconds.size());
    }
    return rows;
  }

 private:
  struct Measured {
    PrecisionRow row;
    RunAt run_at;
    double effort;
    std::vector<double> seconds;
  };

  // Of one method; the next run is expected to take what the last one took, times the growth of work.
  struct Course {
    double next_seconds = 0, next_evaluations = 0, best_error = INFINITY;
    int without_progress = 0;
  };

  static bool is_of_contest(const Place& place) { return place.device == "cpu" && place.precision == 64 && place.threads == 1; }

  // With which a method is stable enough to end near the truth: from steps of 1 rad on by doubling and halving, then by
  // bisection.
  double fewest_steps(const RunAt& run) const {
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

  bool shorten_steps(PrecisionRow like, const std::string& where, double factor, const RunAt& run) {
    if (!go_on_(fmt::format("{}, {}, {}", what_.name, where, like.method))) return false;
    Course course;
    for (double wanted = fewest_steps(run); may_go_on(course); wanted *= factor) {
      const double steps = std::round(wanted);
      like.step = what_.omega * what_.duration / steps;
      if (!go_on_(fmt::format("{}, {}, {}", what_.name, where, like.method))) return false;
      measure(like, steps, run, factor, course);
    }
    return true;
  }

  bool sharpen_tolerance(PrecisionRow like, const RunAt& run) {
    Course course;
    for (like.tolerance = loosest_tolerance; like.tolerance > tightest_tolerance && may_go_on(course);
         like.tolerance /= limits_.sharpening) {
      if (!go_on_(fmt::format("{}, {}, {}", what_.name, like.library, like.method))) return false;
      measure(like, like.tolerance, run, std::pow(limits_.sharpening, 0.2), course);
    }
    return true;
  }

  bool may_go_on(const Course& course) const {
    return course.without_progress < 2 && course.next_seconds <= limits_.longest_run &&
           course.next_evaluations <= limits_.most_evaluations;
  }

  void measure(PrecisionRow row, double effort, const RunAt& run_at, double growth, Course& course) {
    const Run run = run_at(effort);
    row.evaluations = run.evaluations;
    row.contact_steps = run.contact_steps;
    row.error = relative_error(what_, reference_.ending, run.ending);
    course.next_seconds = growth * run.seconds;
    course.next_evaluations = growth * static_cast<double>(run.evaluations);
    if (!(row.error < largest_error)) return;
    course.without_progress = row.error < falling * course.best_error ? 0 : course.without_progress + 1;
    course.best_error = std::min(course.best_error, row.error);
    if (row.error <= reference_.error) course.without_progress = 2;  // less can't be told
    measured_.push_back({std::move(row), run_at, effort, {run.seconds}});
  }

  const PrecisionCase& what_;
  Reference reference_;
  Limits limits_;
  std::function<bool(std::string_view)> go_on_;
  std::optional<PeerSystem> system_;
  std::vector<Measured> measured_;
};

class Suite {
 public:
  Suite(const PrecisionOptions& options, const Progress& progress)
      : limits_(options.quick ? quick_limits : full_limits),
        places_(choose_places(options)),
        all_(make_precision_cases(options.scenes, options.quick)),
        progress_(progress) {
    result_.notes = all_.notes;
    if (!sundials_version().empty()) result_.versions["SUNDIALS"] = sundials_version();
    if (!boost_version().empty()) result_.versions["Boost"] = boost_version();
    for (std::string& missing : missing_peers()) result_.notes.push_back(std::move(missing));
    for (const Place& place : places_) devices_.push_back(open(place));
    reference_device_ = make_cpu_device(options.devices.threads, 64);
  }

  PrecisionResult run() && {
    for (std::size_t k = 0; k < all_.cases.size() && !result_.interrupted; ++k)
      result_.interrupted = !measure(all_.cases[k], static_cast<double>(k) / static_cast<double>(all_.cases.size()));
    if (!result_.interrupted) progress_(1, "");
    return std::move(result_);
  }

 private:
  // Of quick measurements all run on one thread.
  static std::vector<Place> choose_places(const PrecisionOptions& options) {
    constexpr int precisions[] = {64, 32};
    std::vector<Place> places = places_of(options.devices, precisions);
    if (options.quick) std::erase_if(places, [](const Place& place) { return place.device == "cpu" && place.threads > 1; });
    return places;
  }

  bool measure(const PrecisionCase& what, double done) {
    if (!progress_(done, what.name + ", reference")) return false;
    Reference reference = find_reference(*reference_device_, what);
    result_.cases.push_back(info_of(what, reference.error));
    Sweeps sweeps(what, std::move(reference), limits_, [&](std::string_view next) { return progress_(done, next); });
    const bool on = sweep(sweeps, what) && sweeps.repeat();
    result_.cases.back().is_complete = on;
    const std::vector<PrecisionRow> rows = sweeps.rows();
    result_.rows.insert(result_.rows.end(), rows.begin(), rows.end());
    return on;
  }

  bool sweep(Sweeps& sweeps, const PrecisionCase& what) {
    for (std::size_t p = 0; p < places_.size(); ++p) {
      run_once(*devices_[p], what, find_integrator("dop853"), 1);  // builds the kernels
      if (!sweeps.pliant(*devices_[p], places_[p])) return false;
      if (p > 0 || !what.with_peers || places_[p].device != "cpu") continue;
      if (!sweeps.peers()) return false;
      result_.cases.back().seconds_of_rates = sweeps.seconds_of_rates();
    }
    return true;
  }

  Limits limits_;
  std::vector<Place> places_;
  PrecisionCases all_;
  const Progress& progress_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::unique_ptr<Device> reference_device_;
  PrecisionResult result_;
};

}  // namespace

PrecisionResult bench_precision(const PrecisionOptions& options, const Progress& progress) {
  return Suite(options, progress).run();
}

}  // namespace pliant::bench
