#include "bench/draw/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

Json row_json(const DrawRow& row) {
  Json json = {{"scene", row.scene},
               {"device", "gpu"},
               {"vertices", row.vertices},
               {"triangles", row.triangles},
               {"bodies", row.bodies},
               {"clustered_bodies", row.clustered_bodies},
               {"detail", row.detail},
               {"width", row.width},
               {"height", row.height},
               {"milliseconds_per_frame", row.milliseconds_per_frame},
               {"fastest_milliseconds_per_frame", row.fastest_milliseconds_per_frame},
               {"steps_lost", row.steps_lost}};
  if (row.played) {
    const auto& [pictures, late, dropped, simulation, drawing, slowest] = *row.played;
    json.add("played_pictures", pictures);
    json.add("late_pictures", late);
    json.add("seconds_dropped", dropped);
    json.add("simulation_milliseconds_per_picture", simulation);
    json.add("drawing_milliseconds_per_picture", drawing);
    json.add("slowest_picture_milliseconds", slowest);
  }
  for (const auto& [pass, milliseconds] : row.milliseconds) json.add(pass + "_milliseconds", milliseconds);
  return json;
}

}  // namespace

std::string to_table(const DrawResult& result) {
  const std::size_t width = width_of(result.rows, &DrawRow::scene);
  std::string table =
      fmt::format("{:<{}} {:>9} {:>11} {:>9} {:>10}", "scene", width, "triangles", "pixels", "ms/frame", "steps lost");
  if (!result.rows.empty())
    for (const auto& [pass, milliseconds] : result.rows.front().milliseconds) table += fmt::format(" {:>9}", pass);
  for (const DrawRow& row : result.rows) {
    table += fmt::format("\n{:<{}} {:>9} {:>11} {:>9.4g} {:>10}", row.scene, width, row.triangles,
                         fmt::format("{} x {}", row.width, row.height), row.milliseconds_per_frame,
                         row.steps_lost ? fmt::format("{:.1f} %", 100 * *row.steps_lost) : "-");
    for (const auto& [pass, milliseconds] : row.milliseconds) table += fmt::format(" {:>9.4g}", milliseconds);
  }
  if (std::ranges::any_of(result.rows, [](const DrawRow& row) { return row.played.has_value(); }))
    table +=
        fmt::format("\n\n{:<{}} {:>9} {:>12} {:>12} {:>12} {:>9} {:>10}", "played at 60 a second",
                    std::max(width, std::size_t{21}), "pictures", "simulated ms", "drawn ms", "slowest ms", "late", "s dropped");
  for (const DrawRow& row : result.rows)
    if (row.played)
      table +=
          fmt::format("\n{:<{}} {:>9} {:>12.3g} {:>12.3g} {:>12.3g} {:>9} {:>10.3g}", row.scene, std::max(width, std::size_t{21}),
                      row.played->pictures, row.played->simulation_milliseconds, row.played->drawing_milliseconds,
                      row.played->slowest_picture_milliseconds, row.played->late, row.played->seconds_dropped);
  table += '\n';
  for (const std::string& note : result.notes) table += note + '\n';
  return table;
}

std::string to_json(const Machine& machine, const DrawOptions& options, const DrawResult& result) {
  const Json asked = {{"gpu_index", options.gpu_index},
                      {"scenes", options.scenes.string()},
                      {"width", options.size.x},
                      {"height", options.size.y},
                      {"quick", options.quick}};
  return text_of(results_json("draw", machine, asked, result.interrupted, list_of(result.rows, row_json), result.notes));
}

}  // namespace pliant::bench
