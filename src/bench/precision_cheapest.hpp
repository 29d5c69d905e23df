// Which method reaches an error in the least time.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/precision.hpp"

namespace pliant::bench {

/// Errors that tables ask for: 1e-2 to 1e-12.
[[nodiscard]] std::span<const double> asked_errors();
/// Those for which pliant shall be ahead of other libraries.
inline constexpr double largest_contest_error = 1e-3, smallest_contest_error = 1e-10;

struct ErrorTime {
  double error = 0;
  double seconds = 0;  // both above zero
};

/// The least time that reaches `error`. Points are in the order of growing work; between neighbours logarithms are interpolated,
/// and beyond them nothing is: where all points are better, the least time of these. Empty where none is good enough.
[[nodiscard]] std::optional<double> seconds_to_reach(double error, std::span<const ErrorTime> points);

/// The method, device, precision and threads of some rows.
struct Contender {
  std::string library, method;
  bool adaptive = false;
  std::string device;
  int precision = 64;
  unsigned threads = 1;

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
[[nodiscard]] std::string name_of_place(const Contender& contender);

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
  std::optional<Winner> any, pliant, arkode, odeint;

  /// Time of the faster library over pliant's; empty where one of both is missing.
  [[nodiscard]] std::optional<double> lead() const;
};

/// For every case and asked error that some method reaches.
[[nodiscard]] std::vector<CheapestRow> find_cheapest(const PrecisionResult& result);

/// What came of the comparison with other libraries: sentences, the lost errors by name. Empty without their rows.
[[nodiscard]] std::vector<std::string> verdict_of(const PrecisionResult& result);

}  // namespace pliant::bench
