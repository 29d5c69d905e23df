// Which method reaches an error at the least cost.
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

/// Errors that tables ask for: 1e-2 to 1e-12.
[[nodiscard]] std::span<const double> asked_errors();
/// Those for which pliant shall be ahead of other libraries.
inline constexpr double largest_contest_error = 1e-3, smallest_contest_error = 1e-10;

struct ErrorCost {
  double error = 0;
  double cost = 0;  // both above zero
};

/// The least cost that reaches `error`. Points are in the order of growing work; between neighbours logarithms are interpolated,
/// and beyond them nothing is: where all points are better, the least cost of these. Empty where none is good enough.
[[nodiscard]] std::optional<double> cost_to_reach(double error, std::span<const ErrorCost> points);

/// Where a row was measured.
struct PrecisionPlace {
  std::string library, device;
  int precision = 64;
  unsigned threads = 1;

  bool operator==(const PrecisionPlace&) const = default;
};

/// The method of some rows, and their place.
struct Contender {
  PrecisionPlace place;
  std::string method;
  bool adaptive = false;

  bool operator==(const Contender&) const = default;
};

[[nodiscard]] Contender contender_of(const PrecisionRow& row);
/// In the rows' order.
[[nodiscard]] std::vector<Contender> contenders_of(const PrecisionResult& result, const std::string& case_name);
[[nodiscard]] std::optional<double> seconds_to_reach(double error, const PrecisionResult& result, const std::string& case_name,
                                                     const Contender& contender);
/// Such as "vern8", "verner_8_5_6 (adaptive)".
[[nodiscard]] std::string name_of_method(const Contender& contender);
/// Such as "cpu x 1, fp64", "gpu", "ARKODE".
[[nodiscard]] std::string name_of_place(const PrecisionPlace& place);

struct Winner {
  Contender contender;
  double seconds = 0;
};

using Admission = std::function<bool(const Contender&)>;
/// Empty where no admitted one reaches the error.
[[nodiscard]] std::optional<Winner> find_winner(double error, const PrecisionResult& result, const std::string& case_name,
                                                const Admission& admits);

/// The cheapest of all, and of one thread in fp64 by library: there all sum the same forces.
struct CheapestRow {
  std::string case_name;
  double error = 0;
  std::optional<Winner> any, pliant;
  std::array<std::optional<Winner>, peer_libraries.size()> peers;

  /// Time of the fastest other library over pliant's; empty where one of both is missing.
  [[nodiscard]] std::optional<double> lead() const;
};

/// For every case and asked error that some method reaches.
[[nodiscard]] std::vector<CheapestRow> find_cheapest(const PrecisionResult& result);

enum class Standing { faster, level, slower };
[[nodiscard]] const char* name_of(Standing standing);
/// Times differ by some percent from run to run: leads within 5 % either way are level.
[[nodiscard]] Standing standing_of(double lead);

/// One entry of the comparison with other libraries: a contest's case that was not interrupted, at an error that pliant shall
/// lead at and some other library reaches. Where pliant does not reach it, it is slower, with no lead.
struct ContestEntry {
  std::string case_name;
  double error = 0;
  std::optional<double> lead;
  Standing standing = Standing::slower;
};
[[nodiscard]] std::vector<ContestEntry> contest_of(const PrecisionResult& result);

/// What came of the contest, and how much of it could not be held: a sentence; empty without entries.
[[nodiscard]] std::string verdict_of(const PrecisionResult& result);

/// Time of a run over its force evaluations, on one thread in fp64: the median over a library's rows [s].
struct EvaluationCost {
  std::string case_name, library;
  double seconds = 0;
};
/// Of the contest's cases. What is beyond PrecisionCaseInfo::seconds_of_rates is the integrator's own.
[[nodiscard]] std::vector<EvaluationCost> evaluation_costs(const PrecisionResult& result);

/// The least that an error costs at one place by any method, at ten errors a decade: what a picture draws.
struct CostCurve {
  std::string case_name;
  PrecisionPlace place;
  std::vector<double> errors, seconds, evaluations;  // errors falling
};
[[nodiscard]] std::vector<CostCurve> cost_curves(const PrecisionResult& result);

}  // namespace pliant::bench
