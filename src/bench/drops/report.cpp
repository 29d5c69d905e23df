#include "bench/drops/report.hpp"

#include <fmt/format.h>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

Json row_json(const DropRow& row) {
  return {{"drop", row.drop},
          {"engine", row.engine},
          {"device", name_of(row.device)},
          {"threads", threads_json(row.device, row.threads)},
          {"vertices", row.vertices},
          {"time_step", row.time_step},
          {"seconds_per_second", row.seconds_per_second},
          {"intersections", row.intersections},
          {"depth", row.depth},
          {"least_volume", row.least_volume},
          {"most_energy", row.most_energy},
          {"sideways", row.sideways},
          {"last_height", row.last_height}};
}

}  // namespace

std::string to_table(const DropsResult& result) {
  const std::size_t width = width_of(result.rows, &DropRow::engine);
  std::string table = fmt::format("{:<12} {:<{}} {:<6} {:>7} {:>8} {:>8} {:>8} {:>9} {:>9} {:>7} {:>9} {:>9} {:>7}\n", "drop",
                                  "engine", width, "device", "threads", "vertices", "step ms", "s per s", "intersect", "depth m",
                                  "volume", "energy", "sideways", "height");
  for (const DropRow& row : result.rows)
    table += fmt::format("{:<12} {:<{}} {:<6} {:>7} {:>8} {:>8.3g} {:>8.3g} {:>9} {:>9.2g} {:>7.3f} {:>9.2g} {:>9.2g} {:>7.3f}\n",
                         row.drop, row.engine, width, name_of(row.device), threads_text(row.device, row.threads), row.vertices,
                         1e3 * row.time_step, row.seconds_per_second, row.intersections, row.depth, row.least_volume,
                         row.most_energy, row.sideways, row.last_height);
  for (const std::string& note : result.notes) table += note + '\n';
  return table;
}

std::string to_json(const Machine& machine, const DropsOptions& options, const DropsResult& result) {
  return text_of(results_json("drops", machine, options_json(options.devices, options.quick), result.interrupted,
                              list_of(result.rows, row_json), result.notes));
}

}  // namespace pliant::bench
