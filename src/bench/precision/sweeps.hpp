// Makes the sweeps of the suite `precision`: methods run with ever more effort, and each run that did not fail gives a row.
#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/common/place.hpp"
#include "bench/peers/peers.hpp"
#include "bench/precision/precision.hpp"
#include "bench/precision/runs.hpp"

namespace pliant::bench {

struct SweepLimits {
  double longest_run = 0;  // [s]
  double most_evaluations = 0;
  int rounds = 1;
};

/// Measures one case. Sweeps over efforts, which are numbers of steps or tolerances, make rows. Then all rows run again in
/// rounds, so that a slow moment of the machine affects one run of a row, not all.
class Sweeps {
 public:
  /// Is called with what is measured next. If it returns false, the sweeps end.
  using GoOn = std::function<bool(std::string_view next)>;

  /// `what` must outlive the sweeps.
  Sweeps(const PrecisionCase& what, Reference reference, const SweepLimits& limits, GoOn go_on);

  // The next four return false if the suite ends. `device` must outlive the sweeps.

  /// Sweeps every method that meets the damping. The first run has the fewest steps that end near the truth.
  bool steps(Device& device, const Place& place);
  /// Sweeps dop853 and the methods that integrator = "auto" takes for one of the tolerances. The tolerances are a factor of ten
  /// apart and are those that the method can meet in the place's precision.
  bool tolerances(Device& device, const Place& place);
  /// Sweeps steps and tolerances of other libraries' methods. Expects one body without contacts.
  bool peers();
  /// Runs all rows again.
  bool repeat();

  /// Returns the time of one evaluation by the peers' system [s]. Expects that peers() has run.
  [[nodiscard]] double seconds_of_rates();
  [[nodiscard]] std::vector<PrecisionRow> rows() const;

 private:
  using RunAt = std::function<Run(double effort)>;

  struct Measured {
    PrecisionRow row;
    RunAt run_at;
    double effort;
    std::vector<double> seconds;
  };

  // The trend of one method. `next_...` is what the next run should take: what the last one took, times the growth of work.
  struct Trend {
    double next_seconds = 0, next_evaluations = 0, best_error = INFINITY;
    std::uint64_t evaluations = 0;  // of the last run
    int without_progress = 0;       // runs with more evaluations but without a smaller error
  };

  [[nodiscard]] PrecisionRow row_like(const Integrator& integrator, const Place& place) const;
  [[nodiscard]] bool goes_on(const std::string& where, const PrecisionRow& like) const;
  [[nodiscard]] bool may_go_on(const Trend& trend) const;
  [[nodiscard]] double fewest_steps(const RunAt& run) const;
  bool shorten_steps(PrecisionRow like, const std::string& where, double factor, const RunAt& run);
  bool sharpen_tolerance(PrecisionRow like, const std::string& where, double smallest, const RunAt& run);
  void measure(PrecisionRow row, double effort, const RunAt& run_at, double growth, Trend& trend);

  const PrecisionCase& what_;
  Reference reference_;
  SweepLimits limits_;
  GoOn go_on_;
  std::optional<PeerSystem> system_;
  std::vector<Measured> measured_;
};

}  // namespace pliant::bench
