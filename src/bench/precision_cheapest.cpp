#include "bench/precision_cheapest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pliant::bench {
namespace {

// Between neighbours on both sides of the error.
double interpolate(double error, const ErrorTime& worse, const ErrorTime& better) {
  const double part = std::log(worse.error / error) / std::log(worse.error / better.error);
  return worse.seconds * std::pow(better.seconds / worse.seconds, part);
}

void keep_least(std::optional<double>& least, double seconds) { least = least ? std::min(*least, seconds) : seconds; }

Admission one_thread_of(std::string library) {
  return [library = std::move(library)](const Contender& contender) {
    return contender.library == library && contender.device == "cpu" && contender.precision == 64 && contender.threads == 1;
  };
}

bool is_asked_of_contest(double error) {
  return error <= 1.001 * largest_contest_error && error >= 0.999 * smallest_contest_error;
}

}  // namespace

std::span<const double> asked_errors() {
  static constexpr std::array<double, 11> errors{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
  return errors;
}

std::optional<double> seconds_to_reach(double error, std::span<const ErrorTime> points) {
  std::optional<double> least;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].error <= error) keep_least(least, points[k].seconds);
    if (k > 0 && points[k - 1].error > error && points[k].error < error)
      keep_least(least, interpolate(error, points[k - 1], points[k]));
  }
  return least;
}

Contender contender_of(const PrecisionRow& row) {
  return {row.library, row.method, row.adaptive, row.device, row.precision, row.threads};
}

std::vector<Contender> contenders_of(const PrecisionResult& result, const std::string& case_name) {
  std::vector<Contender> contenders;
  for (const PrecisionRow& row : result.rows)
    if (row.case_name == case_name && std::ranges::find(contenders, contender_of(row)) == contenders.end())
      contenders.push_back(contender_of(row));
  return contenders;
}

std::optional<double> seconds_to_reach(double error, const PrecisionResult& result, const std::string& case_name,
                                       const Contender& contender) {
  std::vector<ErrorTime> points;
  for (const PrecisionRow& row : result.rows)
    if (row.case_name == case_name && contender_of(row) == contender) points.push_back({row.error, row.seconds});
  return seconds_to_reach(error, points);
}

std::string name_of_method(const Contender& contender) { return contender.method + (contender.adaptive ? " (adaptive)" : ""); }

std::string name_of_place(const Contender& contender) {
  if (contender.library != "pliant") return contender.library;
  return contender.device == "gpu" ? "gpu" : fmt::format("cpu x {}, fp{}", contender.threads, contender.precision);
}

std::optional<Winner> find_winner(double error, const PrecisionResult& result, const std::string& case_name,
                                  const Admission& admits) {
  std::optional<Winner> winner;
  for (const Contender& contender : contenders_of(result, case_name)) {
    if (!admits(contender)) continue;
    const std::optional<double> seconds = seconds_to_reach(error, result, case_name, contender);
    if (seconds && (!winner || *seconds < winner->seconds)) winner = {contender, *seconds};
  }
  return winner;
}

std::optional<double> CheapestRow::lead() const {
  if (!pliant || (!arkode && !odeint)) return std::nullopt;
  return std::min(arkode ? arkode->seconds : INFINITY, odeint ? odeint->seconds : INFINITY) / pliant->seconds;
}

std::vector<CheapestRow> find_cheapest(const PrecisionResult& result) {
  std::vector<CheapestRow> rows;
  for (const PrecisionCaseInfo& info : result.cases)
    for (const double error : asked_errors()) {
      const auto winner = [&](const Admission& admits) { return find_winner(error, result, info.name, admits); };
      CheapestRow row{.case_name = info.name,
                      .error = error,
                      .any = winner([](const Contender&) { return true; }),
                      .pliant = winner(one_thread_of("pliant")),
                      .arkode = winner(one_thread_of("ARKODE")),
                      .odeint = winner(one_thread_of("odeint"))};
      if (row.any) rows.push_back(std::move(row));
    }
  return rows;
}

std::vector<std::string> verdict_of(const PrecisionResult& result) {
  const std::vector<CheapestRow> rows = find_cheapest(result);
  std::vector<std::string> verdict;
  for (const PrecisionCaseInfo& info : result.cases) {
    if (!info.is_contest) continue;
    std::vector<std::string> lost;
    double least = INFINITY, most = 0;
    for (const CheapestRow& row : rows) {
      if (row.case_name != info.name || !is_asked_of_contest(row.error) || (!row.arkode && !row.odeint)) continue;
      const double lead = row.lead().value_or(0);
      least = std::min(least, lead);
      most = std::max(most, lead);
      if (lead <= 1) lost.push_back(fmt::format("{:.0e}", row.error));
    }
    if (most == 0) continue;
    verdict.push_back(
        fmt::format("{}, one thread, fp64, errors 1e-3 to 1e-10: pliant is {:.2f} to {:.2f} times as fast as the faster library",
                    info.name, least, most));
    if (!lost.empty()) verdict.back() += fmt::format("; NOT faster at {}", fmt::join(lost, ", "));
  }
  return verdict;
}

}  // namespace pliant::bench
