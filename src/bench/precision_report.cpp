#include "bench/precision_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/precision_cheapest.hpp"
#include "bench/report_parts.hpp"

namespace pliant::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double unsteady_ratio = 1.2, unsteady_share = 0.1;  // of medians over the fastest runs, and of rows

Json row_json(const PrecisionRow& row) {
  return {{"case", row.case_name},
          {"library", row.library},
          {"method", row.method},
          {"adaptive", row.adaptive},
          {"device", row.device},
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
          {"is_contest", info.is_contest}};
}

Json winner_json(const std::optional<Winner>& winner) {
  if (!winner) return nullptr;
  return {
      {"place", name_of_place(winner->contender)}, {"method", name_of_method(winner->contender)}, {"seconds", winner->seconds}};
}

Json cheapest_json(const CheapestRow& row) {
  return {{"case", row.case_name},
          {"error", row.error},
          {"any", winner_json(row.any)},
          {"pliant", winner_json(row.pliant)},
          {"ARKODE", winner_json(row.arkode)},
          {"odeint", winner_json(row.odeint)},
          {"lead", row.lead() ? Json(*row.lead()) : Json(nullptr)}};
}

template <class Items, class ToJson>
Json list_of(const Items& items, ToJson to_json_of) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(to_json_of(item));
  return list;
}

// What was left out, what came of the comparison, and how far to trust times.
std::vector<std::string> notes_of(const PrecisionResult& result) {
  std::vector<std::string> notes = result.notes;
  const auto unsteady = std::ranges::count_if(
      result.rows, [](const PrecisionRow& row) { return row.seconds > unsteady_ratio * row.fastest_seconds; });
  if (static_cast<double>(unsteady) > unsteady_share * static_cast<double>(result.rows.size()))
    notes.push_back(fmt::format("the machine was busy: {} of {} rows took over {} times their fastest run; measure again",
                                unsteady, result.rows.size(), unsteady_ratio));
  for (std::string& sentence : verdict_of(result)) notes.push_back(std::move(sentence));
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
    if (contender.device != "gpu" && (contender.precision != 64 || contender.threads != 1)) continue;
    table += fmt::format("{:<14} {:<30}", name_of_place(contender), name_of_method(contender));
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
  std::string table = fmt::format("{:<7} {:<34} | {:<20} {:<36} {:<36} {:>6}\n", "error", "cheapest [ms]", "fp64 x 1: pliant",
                                  "ARKODE", "odeint", "lead");
  for (const CheapestRow& row : find_cheapest(result))
    if (row.case_name == case_name)
      table += fmt::format("{:<7.0e} {:<34} | {:<20} {:<36} {:<36} {:>6}\n", row.error,
                           fmt::format("{}, {}", name_of_place(row.any->contender), text_of(row.any)), text_of(row.pliant),
                           text_of(row.arkode), text_of(row.odeint), row.lead() ? fmt::format("{:.2f}", *row.lead()) : "-");
  return table;
}

}  // namespace

std::string to_table(const PrecisionResult& result) {
  std::string table;
  for (const PrecisionCaseInfo& info : result.cases)
    table += heading_of(info) + table_of_methods(result, info.name) + '\n' + table_of_cheapest(result, info.name) + '\n';
  for (const std::string& note : notes_of(result)) table += note + '\n';
  return table;
}

std::string to_json(const Machine& machine, const PrecisionOptions& options, const PrecisionResult& result) {
  Json asked = options_json(options.devices, options.quick);
  asked["scenes"] = options.scenes.string();
  return text_of(Json{{"suite", "precision"},
                      {"options", asked},
                      {"interrupted", result.interrupted},
                      {"machine", machine_json(machine)},
                      {"cases", list_of(result.cases, case_json)},
                      {"rows", list_of(result.rows, row_json)},
                      {"cheapest", list_of(find_cheapest(result), cheapest_json)},
                      {"notes", notes_of(result)}});
}

}  // namespace pliant::bench
