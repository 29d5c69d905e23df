#include "bench/precision/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>

#include "bench/common/report_parts.hpp"
#include "bench/precision/cheapest.hpp"

namespace pliant::bench {
namespace {

constexpr double unsteady_ratio = 1.2, unsteady_share = 0.1;  // median over fastest time of a row, and share of such rows

Json row_json(const PrecisionRow& row) {
  return {{"case", row.case_name},
          {"library", row.library},
          {"method", row.method},
          {"adaptive", row.adaptive},
          {"device", name_of(row.device)},
          {"precision", row.precision},
          {"threads", threads_json(row.device, row.threads)},
          {"tolerance", row.adaptive ? Json(row.tolerance) : Json(nullptr)},
          {"step", row.adaptive ? Json(nullptr) : Json(row.step)},
          {"evaluations", row.evaluations},
          {"contact_steps", row.contact_steps},
          {"seconds", row.seconds},
          {"fastest_seconds", row.fastest_seconds},
          {"runs", row.runs},
          {"error", row.error}};
}

Json case_json(const PrecisionCaseInfo& info) {
  return {{"name", info.name},
          {"vertices", info.vertices},
          {"bodies", info.bodies},
          {"damping_law", info.damping_law},
          {"duration", info.duration},
          {"omega", info.omega},
          {"reference_step", info.reference_step},
          {"reference_error", info.reference_error},
          {"is_contest", info.is_contest},
          {"is_complete", info.is_complete},
          {"seconds_of_rates", info.seconds_of_rates > 0 ? Json(info.seconds_of_rates) : Json(nullptr)}};
}

Json winner_json(const std::optional<Winner>& winner) {
  if (!winner) return {};
  return {{"place", name_of_place(winner->contender.place)},
          {"method", name_of_method(winner->contender)},
          {"seconds", winner->seconds}};
}

Json cheapest_json(const CheapestRow& row) {
  Json json{{"case", row.case_name}, {"error", row.error}, {"any", winner_json(row.any)}, {"pliant", winner_json(row.pliant)}};
  for (std::size_t k = 0; k < peer_libraries.size(); ++k) json.add(std::string(peer_libraries[k]), winner_json(row.peers[k]));
  json.add("lead", row.lead());
  return json;
}

Json contest_json(const ContestEntry& entry) {
  return {{"case", entry.case_name}, {"error", entry.error}, {"lead", entry.lead}, {"standing", name_of(entry.standing)}};
}

Json cost_json(const EvaluationCost& cost) {
  return {{"case", cost.case_name}, {"library", cost.library}, {"seconds", cost.seconds}};
}

Json versions_json(const std::map<std::string, std::string>& versions) {
  Json json = Json::object();
  for (const auto& [library, version] : versions) json.add(library, version);
  return json;
}

// Rounds to four digits, which are more than a plot shows.
std::vector<double> rounded(std::vector<double> values) {
  for (double& value : values) value = std::stod(fmt::format("{:.3e}", value));
  return values;
}

Json curve_json(const CostCurve& curve) {
  return {{"case", curve.case_name},
          {"library", curve.place.library},
          {"device", name_of(curve.place.device)},
          {"precision", curve.place.precision},
          {"threads", threads_json(curve.place.device, curve.place.threads)},
          {"errors", rounded(curve.errors)},
          {"seconds", rounded(curve.seconds)},
          {"evaluations", rounded(curve.evaluations)}};
}

// Notes what was left out, the result of the comparison, and how far to trust times.
std::vector<std::string> notes_of(const PrecisionResult& result) {
  std::vector<std::string> notes = result.notes;
  const auto unsteady = std::ranges::count_if(
      result.rows, [](const PrecisionRow& row) { return row.seconds > unsteady_ratio * row.fastest_seconds; });
  if (static_cast<double>(unsteady) > unsteady_share * static_cast<double>(result.rows.size()))
    notes.push_back(fmt::format("the machine was busy: {} of {} rows took over {} times their fastest run; measure again",
                                unsteady, result.rows.size(), unsteady_ratio));
  if (std::string verdict = verdict_of(result); !verdict.empty()) notes.push_back(std::move(verdict));
  return notes;
}

std::string heading_of(const PrecisionCaseInfo& info) {
  return fmt::format("{}: {} vertices, omega T = {:.3g} rad, damping {}; the reference is good to {:.0e}\n", info.name,
                     info.vertices, info.omega * info.duration, info.damping_law, info.reference_error);
}

std::string milliseconds(std::optional<double> seconds) { return seconds ? fmt::format("{:.3g}", 1e3 * *seconds) : "-"; }

std::string table_of_methods(const PrecisionResult& result, const std::string& case_name) {
  std::string table = fmt::format("{:<14} {:<30}", "ms to reach", "");
  for (const double error : asked_errors()) table += fmt::format(" {:>7.0e}", error);
  table += '\n';
  for (const Contender& contender : contenders_of(result, case_name)) {
    const PrecisionPlace& place = contender.place;
    if (place.device != DeviceKind::gpu && (place.precision != 64 || place.threads != 1)) continue;
    table += fmt::format("{:<14} {:<30}", name_of_place(place), name_of_method(contender));
    for (const double error : asked_errors())
      table += fmt::format(" {:>7}", milliseconds(seconds_to_reach(error, result, case_name, contender)));
    table += '\n';
  }
  return table;
}

std::string text_of(const std::optional<Winner>& winner) {
  return winner ? fmt::format("{} {}", name_of_method(winner->contender), milliseconds(winner->seconds)) : "-";
}

std::string table_of_cheapest(const PrecisionResult& result, const std::string& case_name) {
  std::string table = fmt::format("{:<7} {:<44} | {:<28}", "error", "cheapest [ms]", "fp64 x 1: pliant");
  for (const std::string_view library : peer_libraries) table += fmt::format(" {:<36}", library);
  table += '\n';
  for (const CheapestRow& row : find_cheapest(result)) {
    if (row.case_name != case_name) continue;
    table += fmt::format("{:<7.0e} {:<44} | {:<28}", row.error,
                         fmt::format("{}, {}", name_of_place(row.any->contender.place), text_of(row.any)), text_of(row.pliant));
    for (const std::optional<Winner>& peer : row.peers) table += fmt::format(" {:<36}", text_of(peer));
    table += '\n';
  }
  return table;
}

std::string text_of(const ContestEntry& entry) {
  return entry.lead ? fmt::format("{:.2f} {}", *entry.lead, name_of(entry.standing)) : "not reached";
}

// Returns a table with a line for each error and a column for each case.
std::string table_of_contest(const PrecisionResult& result) {
  const std::vector<ContestEntry> contest = contest_of(result);
  if (contest.empty()) return {};
  std::map<double, std::map<std::string, std::string>, std::greater<>> cells;
  for (const ContestEntry& entry : contest) cells[entry.error][entry.case_name] = text_of(entry);
  std::string table = fmt::format("{:<24}", "pliant faster by");
  for (const auto& info : result.cases)
    if (info.is_contest && info.is_complete) table += fmt::format(" {:>24}", info.name);
  table += '\n';
  for (auto& [error, of_cases] : cells) {
    table += fmt::format("{:<24.0e}", error);
    for (const auto& info : result.cases)
      if (info.is_contest && info.is_complete) table += fmt::format(" {:>24}", of_cases[info.name]);
    table += '\n';
  }
  return table + "than the fastest other library; level: within 5 %\n\n";
}

std::string table_of_evaluations(const PrecisionResult& result) {
  std::string table;
  for (const PrecisionCaseInfo& info : result.cases) {
    if (!info.is_contest || info.seconds_of_rates == 0) continue;
    table += fmt::format("us an evaluation, {}: the other libraries' forces alone {:.2f}; with the integrator", info.name,
                         1e6 * info.seconds_of_rates);
    for (const EvaluationCost& cost : evaluation_costs(result))
      if (cost.case_name == info.name) table += fmt::format(" {} {:.2f}", cost.library, 1e6 * cost.seconds);
    table += '\n';
  }
  return table;
}

}  // namespace

std::string to_table(const PrecisionResult& result) {
  std::string table;
  for (const PrecisionCaseInfo& info : result.cases)
    table += heading_of(info) + table_of_methods(result, info.name) + '\n' + table_of_cheapest(result, info.name) + '\n';
  table += table_of_contest(result) + table_of_evaluations(result);
  for (const std::string& note : notes_of(result)) table += note + '\n';
  return table;
}

std::string to_json(const Machine& machine, const PrecisionOptions& options, const PrecisionResult& result) {
  Json asked = options_json(options.devices, options.quick);
  asked.add("scenes", options.scenes.string());
  Json file = suite_json("precision", asked, result.interrupted, machine);
  file.add("versions", versions_json(result.versions));
  file.add("cases", list_of(result.cases, case_json));
  file.add("rows", list_of(result.rows, row_json));
  file.add("cheapest", list_of(find_cheapest(result), cheapest_json));
  file.add("contest", list_of(contest_of(result), contest_json));
  file.add("evaluation_costs", list_of(evaluation_costs(result), cost_json));
  file.add("curves", list_of(cost_curves(result), curve_json));
  file.add("notes", notes_of(result));
  return text_of(file);
}

}  // namespace pliant::bench
