#include "bench/collision/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

Json row_json(const CollisionRow& row) {
  return {{"engine", row.engine},
          {"device", name_of(row.device)},
          {"threads", threads_json(row.device, row.threads)},
          {"overlap", row.overlap},
          {"bodies", row.bodies},
          {"triangles", row.triangles},
          {"build_seconds", row.build_seconds > 0 ? Json(row.build_seconds) : Json()},
          {"refit_seconds", row.refit_seconds},
          {"query_seconds", row.query_seconds},
          {"refit_and_query_seconds", row.refit_and_query_seconds()},
          {"refitted_triangles_per_second", row.refitted_per_second()},
          {"pairs", row.pairs},
          {"agrees", row.agrees}};
}

Json row_json(const ContactStepRow& row) {
  Json json = {{"device", name_of(row.device)},
               {"threads", threads_json(row.device, row.threads)},
               {"triangles", row.triangles},
               {"pressing_contacts", row.pressing_contacts}};
  for (const auto& [group, seconds] : row.seconds) json.add(group + "_seconds", seconds);
  json.add("step_seconds", row.step_seconds);
  json.add("breakdown", row.breakdown.empty() ? Json() : Json(row.breakdown));
  return json;
}

Json groups_json() {
  Json groups = Json::object();
  for (const PassGroup& group : contact_groups()) groups.add(std::string(group.name), group.passes);
  return groups;
}

std::string table_of(const std::vector<ContactStepRow>& rows) {
  if (rows.empty()) return "";
  std::string table =
      fmt::format("\n{:<17} {:>9} {:<6} {:>7} {:>8}", "a step in contact", "triangles", "device", "threads", "pressing");
  for (const PassGroup& group : contact_groups()) table += fmt::format(" {:>14}", fmt::format("{} ms", group.name));
  table += fmt::format(" {:>10}\n", "all ms");
  for (const ContactStepRow& row : rows) {
    table += fmt::format("{:<17} {:>9} {:<6} {:>7} {:>8}", "", row.triangles, name_of(row.device),
                         threads_text(row.device, row.threads), row.pressing_contacts);
    for (const auto& [group, seconds] : row.seconds) table += fmt::format(" {:>14.4g}", 1e3 * seconds);
    table += fmt::format(" {:>10.4g} {}\n", 1e3 * row.step_seconds, row.breakdown);
  }
  for (const PassGroup& group : contact_groups()) table += fmt::format("{}: {}\n", group.name, fmt::join(group.passes, ", "));
  return table + '\n';
}

}  // namespace

std::string to_table(const CollisionResult& result) {
  const std::size_t width = width_of(result.rows, &CollisionRow::engine);
  std::string table = fmt::format("{:>6} {:>9} {:>7}  {:<{}} {:<6} {:>7} {:>10} {:>10} {:>10} {:>10} {:>11} {:>9}\n", "bodies",
                                  "triangles", "overlap", "engine", width, "device", "threads", "build ms", "refit ms",
                                  "query ms", "both ms", "refit M/s", "pairs");
  for (const CollisionRow& row : result.rows) {
    const auto of_tree = [&](double value) { return row.build_seconds > 0 ? fmt::format("{:.4g}", value) : "-"; };
    table += fmt::format("{:>6} {:>9} {:>7}  {:<{}} {:<6} {:>7} {:>10} {:>10} {:>10.4g} {:>10.4g} {:>11} {:>9}{}\n", row.bodies,
                         row.triangles, row.overlap, row.engine, width, name_of(row.device),
                         threads_text(row.device, row.threads), of_tree(1e3 * row.build_seconds),
                         of_tree(1e3 * row.refit_seconds), 1e3 * row.query_seconds, 1e3 * row.refit_and_query_seconds(),
                         of_tree(1e-6 * row.refitted_per_second()), row.pairs, row.agrees ? "" : " differ");
  }
  table += table_of(result.contact_steps);
  for (const std::string& note : result.notes) table += note + '\n';
  return table;
}

std::string to_json(const Machine& machine, const CollisionOptions& options, const CollisionResult& result) {
  const auto rows_json = [](const auto& rows) { return list_of(rows, [](const auto& row) { return row_json(row); }); };
  Json file = results_json("collision", machine, options_json(options.devices, options.quick), result.interrupted,
                           rows_json(result.rows), result.notes);
  file.add("contact_steps", rows_json(result.contact_steps));
  file.add("passes", groups_json());
  return text_of(file);
}

}  // namespace pliant::bench
