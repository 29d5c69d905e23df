// Finds the method that reaches an error at the least cost.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/peers/peers.hpp"
#include "bench/precision/precision.hpp"

namespace pliant::bench {

/// Returns the errors in the tables: 1e-2 to 1e-12.
[[nodiscard]] std::span<const double> asked_errors();
/// The errors at which pliant should be ahead of other libraries.
inline constexpr double largest_contest_error = 1e-3, smallest_contest_error = 1e-10;

struct ErrorCost {
  double error = 0;
  double cost = 0;  // both above zero
};

/// Returns the least cost that reaches `error`, or nothing if no point is good enough. Points must be in the order of growing
/// work. Between neighbours it interpolates logarithms, but it never extrapolates. If all points are better, it is the least cost
/// of these.
[[nodiscard]] std::optional<double> cost_to_reach(double error, std::span<const ErrorCost> points);

/// The library and the machine part of a row.
struct PrecisionPlace {
  std::string library;
  DeviceKind device = DeviceKind::cpu;
  int precision = 64;
  unsigned threads = 1;

  bool operator==(const PrecisionPlace&) const = default;
};

/// A method at a place.
struct Contender {
  PrecisionPlace place;
  std::string method;
  bool adaptive = false;

  bool operator==(const Contender&) const = default;
};

[[nodiscard]] Contender contender_of(const PrecisionRow& row);
/// Returns the contenders of a case in the order of the rows.
[[nodiscard]] std::vector<Contender> contenders_of(const PrecisionResult& result, const std::string& case_name);
[[nodiscard]] std::optional<double> seconds_to_reach(double error, const PrecisionResult& result, const std::string& case_name,
                                                     const Contender& contender);
/// Returns such as "vern8" or "verner_8_5_6 (adaptive)".
[[nodiscard]] std::string name_of_method(const Contender& contender);
/// Returns such as "cpu x 1, fp64", "gpu" or "ARKODE".
[[nodiscard]] std::string name_of_place(const PrecisionPlace& place);

struct Winner {
  Contender contender;
  double seconds = 0;
};

using Admission = std::function<bool(const Contender&)>;
/// Returns the fastest admitted contender, or nothing if none reaches the error.
[[nodiscard]] std::optional<Winner> find_winner(double error, const PrecisionResult& result, const std::string& case_name,
                                                const Admission& admits);

/// The cheapest contender of all, and the cheapest of each library on one thread in fp64, where all sum the same forces.
struct CheapestRow {
  std::string case_name;
  double error = 0;
  std::optional<Winner> any, pliant;
  std::array<std::optional<Winner>, peer_libraries.size()> peers;

  /// Returns the time of the fastest other library over pliant's, or nothing if one of both is missing.
  [[nodiscard]] std::optional<double> lead() const;
};

/// Returns a row for every case and asked error that some method reaches.
[[nodiscard]] std::vector<CheapestRow> find_cheapest(const PrecisionResult& result);

enum class Standing { faster, level, slower };
[[nodiscard]] const char* name_of(Standing standing);
/// Leads within 5 % either way are level, because times differ by some percent from run to run.
[[nodiscard]] Standing standing_of(double lead);

/// One entry of the comparison with other libraries. It is for a complete case of the contest, at an error of the contest that
/// some other library reaches. If pliant does not reach it, there is no lead, and pliant is slower.
struct ContestEntry {
  std::string case_name;
  double error = 0;
  std::optional<double> lead;
  Standing standing = Standing::slower;
};
[[nodiscard]] std::vector<ContestEntry> contest_of(const PrecisionResult& result);

/// Returns a sentence on the result of the contest, and on comparisons that could not be made. It is empty without entries.
[[nodiscard]] std::string verdict_of(const PrecisionResult& result);

/// Fastest time of a row over its force evaluations, on one thread in fp64. `seconds` is the median over a library's rows [s].
struct EvaluationCost {
  std::string case_name, library;
  double seconds = 0;
};
/// Returns the costs for the contest's cases. The part above PrecisionCaseInfo::seconds_of_rates is the integrator's own.
[[nodiscard]] std::vector<EvaluationCost> evaluation_costs(const PrecisionResult& result);

/// The least cost of errors at one place by any method, at ten errors a decade, for plots.
struct CostCurve {
  std::string case_name;
  PrecisionPlace place;
  std::vector<double> errors, seconds, evaluations;  // errors falling
};
[[nodiscard]] std::vector<CostCurve> cost_curves(const PrecisionResult& result);

}  // namespace pliant::bench
