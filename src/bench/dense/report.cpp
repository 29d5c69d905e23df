#include "bench/dense/report.hpp"

#include <fmt/format.h>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

Json row_json(const DenseErrorRow& row) {
  return {{"mesh", row.mesh},
          {"vertices", row.vertices},
          {"accuracy", row.accuracy},
          {"springs_per_vertex", row.springs_per_vertex},
          {"deformation", row.deformation},
          {"error", row.error}};
}

Json if_measured(double seconds) { return seconds > 0 ? Json(seconds) : Json(); }

std::string milliseconds_if_measured(double seconds) { return seconds > 0 ? fmt::format("{:.4g}", 1e3 * seconds) : "-"; }

Json force_json(const DenseForceRow& row) {
  Json passes = Json::object();
  for (const auto& [name, seconds] : row.pass_seconds) passes.add(name, seconds);
  return {{"device", name_of(row.device)},
          {"precision", row.precision},
          {"threads", threads_json(row.device, row.threads)},
          {"mesh", row.mesh},
          {"vertices", row.vertices},
          {"tolerance", row.tolerance},
          {"list_seconds", row.list_seconds},
          {"seconds_per_sum", row.seconds_per_sum},
          {"pass_seconds", std::move(passes)},
          {"direct_seconds_per_sum", if_measured(row.direct_seconds_per_sum)},
          {"seconds_per_step", if_measured(row.seconds_per_step)},
          {"seconds_per_contact_step", if_measured(row.seconds_per_contact_step)},
          {"contact_share", row.contact_share},
          {"direct_seconds_per_step", if_measured(row.direct_seconds_per_step)},
          {"bytes_per_vertex", row.bytes_per_vertex},
          {"error", row.error}};
}

std::string errors_table(const std::vector<DenseErrorRow>& rows) {
  if (rows.empty()) return "";
  std::string table = fmt::format("{:<14} {:>8} {:>9} {:>16}  {:<14} {:>9}\n", "mesh", "vertices", "accuracy", "springs a vertex",
                                  "deformation", "error");
  for (const DenseErrorRow& row : rows)
    table += fmt::format("{:<14} {:>8} {:>9.0e} {:>16.0f}  {:<14} {:>9.1e}\n", row.mesh, row.vertices, row.accuracy,
                         row.springs_per_vertex, row.deformation, row.error);
  return table + '\n';
}

std::string forces_table(const std::vector<DenseForceRow>& rows) {
  if (rows.empty()) return "";
  std::string table = fmt::format("{:<6} {:>4} {:>7} {:>8} {:>9} {:>9} {:>8} {:>9} {:>10} {:>6} {:>9} {:>10} {:>15} {:>14}\n",
                                  "device", "bits", "threads", "vertices", "tolerance", "error", "list ms", "sum ms", "direct ms",
                                  "times", "step ms", "contact ms", "direct step ms", "bytes a vertex");
  for (const DenseForceRow& row : rows)
    table += fmt::format(
        "{:<6} {:>4} {:>7} {:>8} {:>9.0e} {:>9.1e} {:>8.3g} {:>9.4g} {:>10} {:>6} {:>9} {:>10} {:>15} {:>14.0f}\n",
        name_of(row.device), row.precision, threads_text(row.device, row.threads), row.vertices, row.tolerance, row.error,
        1e3 * row.list_seconds, 1e3 * row.seconds_per_sum, milliseconds_if_measured(row.direct_seconds_per_sum),
        row.direct_seconds_per_sum > 0 ? fmt::format("{:.3g}", row.direct_seconds_per_sum / row.seconds_per_sum) : "-",
        milliseconds_if_measured(row.seconds_per_step), milliseconds_if_measured(row.seconds_per_contact_step),
        milliseconds_if_measured(row.direct_seconds_per_step), row.bytes_per_vertex);
  return table + '\n';
}

std::string passes_table(const std::vector<DenseForceRow>& rows) {
  if (rows.empty()) return "";
  std::string table = fmt::format("{:<6} {:>4} {:>8} {:>9}", "device", "bits", "vertices", "tolerance");
  for (const auto& [name, seconds] : rows.front().pass_seconds) table += fmt::format(" {:>16}", name);
  table += "  ms each, alone\n";
  for (const DenseForceRow& row : rows) {
    table += fmt::format("{:<6} {:>4} {:>8} {:>9.0e}", name_of(row.device), row.precision, row.vertices, row.tolerance);
    for (const auto& [name, seconds] : row.pass_seconds) table += fmt::format(" {:>16.4g}", 1e3 * seconds);
    table += '\n';
  }
  return table + '\n';
}

}  // namespace

std::string to_table(const DenseResult& result) {
  std::string table = errors_table(result.rows) + forces_table(result.forces) + passes_table(result.forces);
  for (const std::string& note : result.notes) table += note + '\n';
  return table;
}

std::string to_json(const Machine& machine, const DenseOptions& options, const DenseResult& result) {
  Json file = results_json("dense", machine, options_json(options.devices, options.quick), result.interrupted,
                           list_of(result.rows, row_json), result.notes);
  file.add("forces", list_of(result.forces, force_json));
  return text_of(file);
}

}  // namespace pliant::bench
