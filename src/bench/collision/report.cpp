#include "bench/collision/report.hpp"

#include <fmt/format.h>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

Json row_json(const CollisionRow& row) {
  return {{"engine", row.engine},
          {"device", name_of(row.device)},
          {"threads", threads_json(row.device, row.threads)},
          {"overlap", row.overlap},
          {"triangles", row.triangles},
          {"build_seconds", row.build_seconds > 0 ? Json(row.build_seconds) : Json()},
          {"refit_seconds", row.refit_seconds},
          {"query_seconds", row.query_seconds},
          {"refit_and_query_seconds", row.refit_and_query_seconds()},
          {"pairs", row.pairs},
          {"agrees", row.agrees}};
}

}  // namespace

std::string to_table(const CollisionResult& result) {
  const std::size_t width = width_of(result.rows, &CollisionRow::engine);
  std::string table = fmt::format("{:>9} {:>7}  {:<{}} {:<6} {:>7} {:>10} {:>10} {:>10} {:>10} {:>9}\n", "triangles", "overlap",
                                  "engine", width, "device", "threads", "build ms", "refit ms", "query ms", "both ms", "pairs");
  for (const CollisionRow& row : result.rows)
    table += fmt::format("{:>9} {:>7}  {:<{}} {:<6} {:>7} {:>10} {:>10.4g} {:>10.4g} {:>10.4g} {:>9}{}\n", row.triangles,
                         row.overlap, row.engine, width, name_of(row.device), threads_text(row.device, row.threads),
                         row.build_seconds > 0 ? fmt::format("{:.4g}", 1e3 * row.build_seconds) : "-", 1e3 * row.refit_seconds,
                         1e3 * row.query_seconds, 1e3 * row.refit_and_query_seconds(), row.pairs, row.agrees ? "" : " differ");
  for (const std::string& note : result.notes) table += note + '\n';
  return table;
}

std::string to_json(const Machine& machine, const CollisionOptions& options, const CollisionResult& result) {
  return text_of(results_json("collision", machine, options_json(options.devices, options.quick), result.interrupted,
                              list_of(result.rows, row_json), result.notes));
}

}  // namespace pliant::bench
