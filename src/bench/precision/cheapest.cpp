#include "bench/precision/cheapest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bench/common/timing.hpp"

namespace pliant::bench {
namespace {

constexpr double level_margin = 0.05;
constexpr int errors_a_decade = 10;

// Interpolates between neighbours on both sides of the error.
double interpolate(double error, const ErrorCost& worse, const ErrorCost& better) {
  const double part = std::log(worse.error / error) / std::log(worse.error / better.error);
  return worse.cost * std::pow(better.cost / worse.cost, part);
}

void keep_least(std::optional<double>& least, std::optional<double> cost) {
  if (cost && (!least || *cost < *least)) least = cost;
}

PrecisionPlace place_of(const PrecisionRow& row) { return {row.library, row.device, row.precision, row.threads}; }

bool is_one_thread_of(std::string_view library, const PrecisionPlace& place) {
  return place == PrecisionPlace{std::string(library), DeviceKind::cpu, 64, 1};
}

Admission one_thread_of(std::string_view library) {
  return [library](const Contender& contender) { return is_one_thread_of(library, contender.place); };
}

bool is_asked_of_contest(double error) {
  return error <= 1.001 * largest_contest_error && error >= 0.999 * smallest_contest_error;
}

// Counts a comparison for each power of ten in every case of the contest.
std::size_t comparisons_asked(const PrecisionResult& result) {
  const auto cases = std::ranges::count_if(result.cases, [](const auto& info) { return info.is_contest && info.is_complete; });
  return static_cast<std::size_t>(cases * (1 + std::lround(std::log10(largest_contest_error / smallest_contest_error))));
}

using Cost = double (*)(const PrecisionRow&);
// Takes the fastest run, because other load on the machine can only slow a run down.
double seconds_of(const PrecisionRow& row) { return row.fastest_seconds; }
double evaluations_of(const PrecisionRow& row) { return static_cast<double>(row.evaluations); }

std::vector<ErrorCost> points_of(const PrecisionResult& result, const std::string& case_name, const Contender& contender,
                                 Cost cost) {
  std::vector<ErrorCost> points;
  for (const PrecisionRow& row : result.rows)
    if (row.case_name == case_name && contender_of(row) == contender) points.push_back({row.error, cost(row)});
  return points;
}

// The points of every method at one place, by both costs.
struct PlacePoints {
  std::vector<std::vector<ErrorCost>> seconds, evaluations;
  double largest_error = 0, smallest_error = INFINITY;
};

PlacePoints points_at(const PrecisionResult& result, const std::string& case_name, const PrecisionPlace& place) {
  PlacePoints points;
  for (const Contender& contender : contenders_of(result, case_name)) {
    if (contender.place != place) continue;
    points.seconds.push_back(points_of(result, case_name, contender, seconds_of));
    points.evaluations.push_back(points_of(result, case_name, contender, evaluations_of));
    for (const ErrorCost& point : points.seconds.back()) {
      points.largest_error = std::max(points.largest_error, point.error);
      points.smallest_error = std::min(points.smallest_error, point.error);
    }
  }
  return points;
}

double least_of(double error, const std::vector<std::vector<ErrorCost>>& methods) {
  std::optional<double> least;
  for (const std::vector<ErrorCost>& points : methods) keep_least(least, cost_to_reach(error, points));
  return least.value();
}

CostCurve curve_at(const PrecisionResult& result, const std::string& case_name, const PrecisionPlace& place) {
  CostCurve curve{.case_name = case_name, .place = place, .errors = {}, .seconds = {}, .evaluations = {}};
  const PlacePoints points = points_at(result, case_name, place);
  const auto index_of = [](double error) { return -errors_a_decade * std::log10(error); };
  const int last = static_cast<int>(std::floor(index_of(points.smallest_error)));
  for (int k = static_cast<int>(std::ceil(index_of(points.largest_error))); k <= last; ++k) {
    curve.errors.push_back(std::pow(10.0, -static_cast<double>(k) / errors_a_decade));
    curve.seconds.push_back(least_of(curve.errors.back(), points.seconds));
    curve.evaluations.push_back(least_of(curve.errors.back(), points.evaluations));
  }
  return curve;
}

const PrecisionCaseInfo& info_of(const PrecisionResult& result, const std::string& case_name) {
  return *std::ranges::find(result.cases, case_name, &PrecisionCaseInfo::name);
}

}  // namespace

std::span<const double> asked_errors() {
  static constexpr std::array<double, 11> errors{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
  return errors;
}

std::optional<double> cost_to_reach(double error, std::span<const ErrorCost> points) {
  std::optional<double> least;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].error <= error) keep_least(least, points[k].cost);
    if (k > 0 && points[k - 1].error > error && points[k].error < error)
      keep_least(least, interpolate(error, points[k - 1], points[k]));
  }
  return least;
}

Contender contender_of(const PrecisionRow& row) { return {place_of(row), row.method, row.adaptive}; }

std::vector<Contender> contenders_of(const PrecisionResult& result, const std::string& case_name) {
  std::vector<Contender> contenders;
  for (const PrecisionRow& row : result.rows)
    if (row.case_name == case_name && std::ranges::find(contenders, contender_of(row)) == contenders.end())
      contenders.push_back(contender_of(row));
  return contenders;
}

std::optional<double> seconds_to_reach(double error, const PrecisionResult& result, const std::string& case_name,
                                       const Contender& contender) {
  return cost_to_reach(error, points_of(result, case_name, contender, seconds_of));
}

std::string name_of_method(const Contender& contender) { return contender.method + (contender.adaptive ? " (adaptive)" : ""); }

std::string name_of_place(const PrecisionPlace& place) {
  if (place.library != "pliant") return place.library;
  return place.device == DeviceKind::gpu ? "gpu" : fmt::format("cpu x {}, fp{}", place.threads, place.precision);
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
  std::optional<double> fastest;
  for (const std::optional<Winner>& peer : peers)
    if (peer) keep_least(fastest, peer->seconds);
  if (!pliant || !fastest) return std::nullopt;
  return *fastest / pliant->seconds;
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
                      .peers = {}};
      std::ranges::transform(peer_libraries, row.peers.begin(),
                             [&](std::string_view library) { return winner(one_thread_of(library)); });
      if (row.any) rows.push_back(std::move(row));
    }
  return rows;
}

const char* name_of(Standing standing) {
  return standing == Standing::faster ? "faster" : standing == Standing::level ? "level" : "slower";
}

Standing standing_of(double lead) {
  if (lead > 1 + level_margin) return Standing::faster;
  return lead < 1 / (1 + level_margin) ? Standing::slower : Standing::level;
}

std::vector<ContestEntry> contest_of(const PrecisionResult& result) {
  std::vector<ContestEntry> contest;
  for (const CheapestRow& row : find_cheapest(result)) {
    const PrecisionCaseInfo& info = info_of(result, row.case_name);
    const bool has_rival = std::ranges::any_of(row.peers, [](const auto& peer) { return peer.has_value(); });
    if (!info.is_contest || !info.is_complete || !has_rival || !is_asked_of_contest(row.error)) continue;
    const std::optional<double> lead = row.lead();
    contest.push_back({row.case_name, row.error, lead, lead ? standing_of(*lead) : Standing::slower});
  }
  return contest;
}

std::string verdict_of(const PrecisionResult& result) {
  const std::vector<ContestEntry> contest = contest_of(result);
  if (contest.empty()) return {};
  std::vector<std::string> slower;
  std::size_t faster = 0;
  for (const ContestEntry& entry : contest) {
    faster += entry.standing == Standing::faster;
    if (entry.standing == Standing::slower) slower.push_back(fmt::format("{} at {:.0e}", entry.case_name, entry.error));
  }
  std::string verdict =
      fmt::format("one thread, fp64: of {} comparisons with the fastest other library pliant is faster in {}, level in {}",
                  contest.size(), faster, contest.size() - faster - slower.size());
  verdict += slower.empty() ? ", slower in none" : fmt::format(", SLOWER in {}: {}", slower.size(), fmt::join(slower, ", "));
  if (const std::size_t unmet = comparisons_asked(result) - contest.size(); unmet > 0)
    verdict +=
        fmt::format("; {} of {} could not be made, because no other library reached the error within the limits of the suite",
                    unmet, comparisons_asked(result));
  return verdict;
}

std::vector<EvaluationCost> evaluation_costs(const PrecisionResult& result) {
  std::vector<EvaluationCost> costs;
  const auto add = [&](const PrecisionCaseInfo& info, std::string_view library) {
    std::vector<double> seconds;
    for (const PrecisionRow& row : result.rows)
      if (row.case_name == info.name && is_one_thread_of(library, place_of(row)))
        seconds.push_back(seconds_of(row) / evaluations_of(row));
    if (!seconds.empty()) costs.push_back({info.name, std::string(library), median(std::move(seconds))});
  };
  for (const PrecisionCaseInfo& info : result.cases) {
    if (!info.is_contest) continue;
    add(info, "pliant");
    for (const std::string_view library : peer_libraries) add(info, library);
  }
  return costs;
}

std::vector<CostCurve> cost_curves(const PrecisionResult& result) {
  std::vector<CostCurve> curves;
  for (const PrecisionCaseInfo& info : result.cases) {
    std::vector<PrecisionPlace> places;
    for (const Contender& contender : contenders_of(result, info.name))
      if (std::ranges::find(places, contender.place) == places.end()) places.push_back(contender.place);
    for (const PrecisionPlace& place : places) curves.push_back(curve_at(result, info.name, place));
  }
  return curves;
}

}  // namespace pliant::bench
