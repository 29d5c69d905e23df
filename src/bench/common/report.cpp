#include "bench/common/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

template <class Row>
std::string threads_text(const Row& row) {
  return row.device == "gpu" ? "-" : std::to_string(row.threads);
}

Json row_json(const ForcesRow& row) {
  return {{"device", row.device},
          {"precision", row.precision},
          {"threads", threads_json(row.device, row.threads)},
          {"isa", row.isa},
          {"form", row.form},
          {"variant", row.variant},
          {"vertices", row.vertices},
          {"seconds_per_evaluation", row.seconds_per_evaluation},
          {"fastest_seconds_per_evaluation", row.fastest_seconds_per_evaluation},
          {"pairs_per_second", row.pairs_per_second},
          {"bound_pairs_per_second", row.bound_pairs_per_second},
          {"ratio_to_bound", row.ratio_to_bound},
          {"multiply_adds_per_second", row.multiply_adds_per_second}};
}

Json row_json(const StepsRow& row) {
  return {{"scene", row.scene},
          {"family", row.family},
          {"device", row.device},
          {"precision", row.precision},
          {"threads", threads_json(row.device, row.threads)},
          {"vertices", row.vertices},
          {"bodies", row.bodies},
          {"milliseconds_per_step", row.milliseconds_per_step},
          {"fastest_milliseconds_per_step", row.fastest_milliseconds_per_step},
          {"steps_per_second", row.steps_per_second},
          {"steps", row.steps},
          {"contact_steps", row.contact_steps},
          {"runs", row.runs}};
}

Json row_json(const DrawRow& row) {
  Json json = {{"scene", row.scene},
               {"device", "gpu"},
               {"vertices", row.vertices},
               {"triangles", row.triangles},
               {"bodies", row.bodies},
               {"detail", row.detail},
               {"width", row.width},
               {"height", row.height},
               {"milliseconds_per_frame", row.milliseconds_per_frame},
               {"fastest_milliseconds_per_frame", row.fastest_milliseconds_per_frame},
               {"steps_lost", row.steps_lost}};
  for (const auto& [pass, milliseconds] : row.milliseconds) json.add(pass + "_milliseconds", milliseconds);
  return json;
}

Json crossover_json(const FamilyCrossover& crossover) {
  return {{"family", crossover.family},
          {"threads", crossover.threads},
          {"vertices", crossover.crossover.vertices},
          {"text", to_text(crossover)}};
}

std::vector<std::string> notes_of(const StepsResult& result) { return result.notes; }
std::vector<std::string> notes_of(const DrawResult& result) { return result.notes; }

// A sum can only be faster than its bound if the machine was slower when the bound was measured.
std::vector<std::string> notes_of(const ForcesResult& result) {
  std::vector<std::string> notes = result.notes;
  if (std::ranges::any_of(result.rows, [](const ForcesRow& row) { return row.ratio_to_bound > 1; }))
    notes.emplace_back("the machine was busy: it fell short of its own multiply-adds, as ratios above 1 show; measure again");
  return notes;
}

template <class Result>
Json file_json(const char* suite, const Machine& machine, const Json& options, const Result& result) {
  Json file = suite_json(suite, options, result.interrupted, machine);
  file.add("rows", list_of(result.rows, [](const auto& row) { return row_json(row); }));
  file.add("notes", notes_of(result));
  return file;
}

// Returns a width for the longest text in a column.
template <class Row>
std::size_t width_of(const std::vector<Row>& rows, std::string Row::*text) {
  std::size_t width = 8;
  for (const Row& row : rows) width = std::max(width, (row.*text).size());
  return width;
}

}  // namespace

std::string to_text(const Machine& machine) {
  std::string text = fmt::format("pliant {} (commit {}), {}, {}\n{}, {} threads", machine.version, machine.commit,
                                 machine.compiler, machine.date, machine.cpu, machine.cpu_threads);
  if (machine.gpu) text += fmt::format("; {}, {}", *machine.gpu, machine.driver.value_or(""));
  return text;
}

std::string to_table(const ForcesResult& result) {
  const std::size_t width = width_of(result.rows, &ForcesRow::variant);
  std::string table = fmt::format("{:<6} {:>4} {:>7}  {:<{}} {:>8} {:>12} {:>13} {:>13} {:>7}\n", "device", "bits", "threads",
                                  "variant", width, "vertices", "us a sum", "pairs/s", "bound", "ratio");
  for (const ForcesRow& row : result.rows)
    table += fmt::format("{:<6} {:>4} {:>7}  {:<{}} {:>8} {:>12.2f} {:>13.4g} {:>13.4g} {:>7.3f}\n", row.device, row.precision,
                         threads_text(row), row.variant, width, row.vertices, 1e6 * row.seconds_per_evaluation,
                         row.pairs_per_second, row.bound_pairs_per_second, row.ratio_to_bound);
  for (const std::string& note : notes_of(result)) table += note + '\n';
  return table;
}

std::string to_table(const StepsResult& result) {
  const std::size_t width = width_of(result.rows, &StepsRow::scene);
  std::string table = fmt::format("{:<{}} {:<6} {:>7} {:>8} {:>6} {:>12} {:>10} {:>6} {:>8}\n", "scene", width, "device",
                                  "threads", "vertices", "bodies", "ms/step", "steps/s", "steps", "contacts");
  for (const StepsRow& row : result.rows)
    table += fmt::format("{:<{}} {:<6} {:>7} {:>8} {:>6} {:>12.4g} {:>10.4g} {:>6} {:>8}\n", row.scene, width, row.device,
                         threads_text(row), row.vertices, row.bodies, row.milliseconds_per_step, row.steps_per_second, row.steps,
                         row.contact_steps);
  for (const std::string& note : result.notes) table += note + '\n';
  for (const FamilyCrossover& crossover : result.crossovers) table += to_text(crossover) + '\n';
  return table;
}

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
  table += '\n';
  for (const std::string& note : result.notes) table += note + '\n';
  return table;
}

std::string to_text(const FamilyCrossover& crossover) {
  const std::string opponent =
      fmt::format("{}: against {} CPU thread{}", crossover.family, crossover.threads, crossover.threads == 1 ? "" : "s");
  switch (crossover.crossover.lead) {
    case Lead::crosses:
      return fmt::format("{} the GPU leads from {:.0f} vertices on", opponent, crossover.crossover.vertices.value());
    case Lead::gpu_everywhere:
      return fmt::format("{} the GPU leads at every size measured", opponent);
    case Lead::cpu_everywhere:
      return fmt::format("{} the GPU does not lead at the largest size measured", opponent);
    case Lead::none_measured:
      break;
  }
  return fmt::format("{} no size was measured on both", opponent);
}

std::string to_json(const Machine& machine, const ForcesOptions& options, const ForcesResult& result) {
  Json asked = options_json(options.devices, options.quick);
  asked.add("all_variants", options.all_variants);
  return text_of(file_json("forces", machine, asked, result));
}

std::string to_json(const Machine& machine, const StepsOptions& options, const StepsResult& result) {
  Json asked = options_json(options.devices, options.quick);
  asked.add("scenes", options.scenes.string());
  Json file = file_json("steps", machine, asked, result);
  file.add("crossovers", list_of(result.crossovers, crossover_json));
  return text_of(file);
}

std::string to_json(const Machine& machine, const DrawOptions& options, const DrawResult& result) {
  const Json asked = {{"gpu_index", options.gpu_index},
                      {"scenes", options.scenes.string()},
                      {"width", options.size.x},
                      {"height", options.size.y},
                      {"quick", options.quick}};
  return text_of(file_json("draw", machine, asked, result));
}

}  // namespace pliant::bench
