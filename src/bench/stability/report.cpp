#include "bench/stability/report.hpp"

#include <fmt/format.h>

#include <array>
#include <tuple>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

const char* name_of(Outcome outcome) {
  constexpr std::array<const char*, 4> names{"stable", "damped", "creeping", "blown up"};
  return names[static_cast<std::size_t>(outcome)];
}

std::string line(const LimitRow& row) {
  const std::string step = row.measured_step ? fmt::format("{:.5g}", 1e3 * *row.measured_step) : "-";
  const std::string ratio = row.measured_step ? fmt::format("{:.3f}", *row.measured_step / row.predicted_step) : "-";
  return fmt::format("{:<10} {:<6} {:>4} {:>8} {:>7} {:>8.4g} {:>9} {:>6} {:>13.5g} {:>12} {:>7}\n", row.integrator,
                     name_of(row.device), row.precision, row.vertices, row.stiffness, row.damping, row.amplitude, row.steps,
                     1e3 * row.predicted_step, step, ratio);
}

std::string line(const DriftRow& row) {
  return fmt::format("{:<10} {:<6} {:>4} {:>8} {:>8} {:>13.3g} {:>13.3g}\n", row.integrator, name_of(row.device), row.precision,
                     row.vertices, row.steps, row.energy_drift, row.predicted_drift);
}

std::string line(const ErrorRow& row) {
  const std::string error = row.error ? fmt::format("{:.2e}", *row.error) : "-";
  return fmt::format("{:<10} {:<8} {:<6} {:>4} {:>8} {:>9} {:>8} {:>6} {:>6} {:>9} {:>10.2e} {:>10.2e} {:>7}\n", row.family,
                     row.integrator, name_of(row.device), row.precision, row.vertices, row.amplitude, row.distance, row.turns,
                     row.steps, error, row.energy_change, row.angular_momentum_change, row.frame_changes);
}

template <class Row>
std::string lines_of(const StabilityResult& result, const std::string& header) {
  std::string lines;
  for (const StabilityRow& row : result.rows)
    if (const auto* found = std::get_if<Row>(&row)) lines += line(*found);
  return lines.empty() ? lines : header + lines + '\n';
}

char letter(const MapRow& row) { return "o.~#"[static_cast<std::size_t>(row.outcome)]; }

// Returns maps with a line for each damping, a letter for each step, and a bar at the predicted bound.
std::string maps(const StabilityResult& result) {
  std::string text;
  std::string title_before;
  const MapRow* before = nullptr;
  for (const StabilityRow& any : result.rows) {
    const auto* row = std::get_if<MapRow>(&any);
    if (row == nullptr) continue;
    const std::string title =
        fmt::format("{}, {} damping, {} vertices, k = {}", row->integrator, row->law, row->vertices, row->stiffness);
    if (title != title_before) text += fmt::format("{}{}\n", text.empty() ? "" : "\n", title);
    const bool new_line = title != title_before || before->damping != row->damping;
    if (new_line) text += fmt::format("{}  c {:>9.4g}  ", title == title_before ? "\n" : "", row->damping);
    const bool was_within = new_line || before->time_step <= before->predicted_bound;
    if (was_within && row->time_step > row->predicted_bound) text += '|';
    text += letter(*row);
    title_before = title;
    before = row;
  }
  if (text.empty()) return text;
  return "maps: steps from 0.1 to 4 of the undamped bound, for each damping c [kg/s];\n"
         "o stable, . damped to rest, ~ creeping back to shape, # blown up, | the predicted bound\n\n" +
         text + "\n\n";
}

Json row_json(const LimitRow& row) {
  return {{"kind", "limit"},
          {"integrator", row.integrator},
          {"device", name_of(row.device)},
          {"precision", row.precision},
          {"vertices", row.vertices},
          {"stiffness", row.stiffness},
          {"damping", row.damping},
          {"amplitude", row.amplitude},
          {"steps", row.steps},
          {"predicted_step", row.predicted_step},
          {"measured_step", row.measured_step}};
}

Json row_json(const MapRow& row) {
  return {{"kind", "map"},
          {"integrator", row.integrator},
          {"device", name_of(row.device)},
          {"precision", row.precision},
          {"vertices", row.vertices},
          {"stiffness", row.stiffness},
          {"law", row.law},
          {"damping", row.damping},
          {"time_step", row.time_step},
          {"undamped_bound", row.undamped_bound},
          {"predicted_bound", row.predicted_bound},
          {"steps", row.steps},
          {"outcome", name_of(row.outcome)},
          {"energy_ratio", row.energy_ratio}};
}

Json row_json(const DriftRow& row) {
  return {{"kind", "drift"},
          {"integrator", row.integrator},
          {"device", name_of(row.device)},
          {"precision", row.precision},
          {"vertices", row.vertices},
          {"omega_step", row.omega_step},
          {"steps", row.steps},
          {"energy_drift", row.energy_drift},
          {"predicted_drift", row.predicted_drift}};
}

Json row_json(const ErrorRow& row) {
  return {{"kind", "error"},
          {"family", row.family},
          {"integrator", row.integrator},
          {"device", name_of(row.device)},
          {"precision", row.precision},
          {"vertices", row.vertices},
          {"amplitude", row.amplitude},
          {"distance", row.distance},
          {"turns", row.turns},
          {"steps", row.steps},
          {"error", row.error},
          {"energy_change", row.energy_change},
          {"angular_momentum_change", row.angular_momentum_change},
          {"frame_changes", row.frame_changes}};
}

}  // namespace

std::string to_table(const StabilityResult& result) {
  std::string table = lines_of<LimitRow>(
      result, fmt::format("{:<10} {:<6} {:>4} {:>8} {:>7} {:>8} {:>9} {:>6} {:>13} {:>12} {:>7}\n", "limits", "device", "bits",
                          "vertices", "k", "c", "amplitude", "steps", "predicted, ms", "measured, ms", "ratio"));
  table += maps(result);
  table += lines_of<DriftRow>(result, fmt::format("{:<10} {:<6} {:>4} {:>8} {:>8} {:>13} {:>13}\n", "energy", "device", "bits",
                                                  "vertices", "steps", "drift", "the method's"));
  table +=
      lines_of<ErrorRow>(result, fmt::format("{:<10} {:<8} {:<6} {:>4} {:>8} {:>9} {:>8} {:>6} {:>6} {:>9} {:>10} {:>10} {:>7}\n",
                                             "errors", "method", "device", "bits", "vertices", "amplitude", "distance", "turns",
                                             "steps", "error", "energy", "spin", "frames"));
  for (const std::string& note : result.notes) table += note + '\n';
  return table;
}

std::string to_json(const Machine& machine, const StabilityOptions& options, const StabilityResult& result) {
  Json file = suite_json("stability", options_json(options.devices, options.quick), result.interrupted, machine);
  file.add("rows", list_of(result.rows, [](const StabilityRow& row) {
             return std::visit([](const auto& known) { return row_json(known); }, row);
           }));
  file.add("notes", result.notes);
  return text_of(file);
}

}  // namespace pliant::bench
