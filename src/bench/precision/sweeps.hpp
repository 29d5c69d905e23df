// Sweeps of the suite `precision`: methods run with ever more effort, and each run that tells something is a row.
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

/// One case: sweeps over efforts, that is numbers of steps or tolerances, make rows. All are then run again in rounds, so that a
/// bad moment of the machine meets one run of a row, not all.
class Sweeps {
 public:
  /// Hears what is measured next; the sweeps end early where it answers false.
  using GoOn = std::function<bool(std::string_view next)>;

  /// `what` must outlive the sweeps.
  Sweeps(const PrecisionCase& what, Reference reference, const SweepLimits& limits, GoOn go_on);

  // Those that answer: false where the suite ends.

  /// Every method that meets the damping, from as few steps on as end near the truth. `device`, here and below, must outlive the
  /// sweeps.
  bool steps(Device& device, const Place& place);
  /// Those methods that integrator = "auto" takes for one of the tolerances, and dop853 beside; the tolerances, a factor of ten
  /// apart, are those that the place's precision carries.
  bool tolerances(Device& device, const Place& place);
  /// Both, of other libraries. Expects one body without contacts.
  bool peers();
  /// All rows again.
  bool repeat();

  /// That the peers' system takes for one evaluation [s]. Expects that they ran.
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

  // Of one method; the next run is expected to take what the last one took, times the growth of work.
  struct Trend {
    double next_seconds = 0, next_evaluations = 0, best_error = INFINITY;
    std::uint64_t evaluations = 0;  // of the last one
    int without_progress = 0;       // runs that took more of them
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
