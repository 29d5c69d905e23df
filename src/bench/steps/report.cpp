#include "bench/steps/report.hpp"

#include <fmt/format.h>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

Json row_json(const StepsRow& row) {
  return {{"scene", row.scene},
          {"family", row.family},
          {"device", name_of(row.device)},
          {"precision", row.precision},
          {"threads", threads_json(row.device, row.threads)},
          {"vertices", row.vertices},
          {"bodies", row.bodies},
          {"clustered_bodies", row.clustered_bodies},
          {"milliseconds_per_step", row.milliseconds_per_step},
          {"fastest_milliseconds_per_step", row.fastest_milliseconds_per_step},
          {"steps_per_second", row.steps_per_second},
          {"steps", row.steps},
          {"contact_steps", row.contact_steps},
          {"runs", row.runs}};
}

Json crossover_json(const FamilyCrossover& crossover) {
  return {{"family", crossover.family},
          {"threads", crossover.threads},
          {"vertices", crossover.crossover.vertices},
          {"text", to_text(crossover)}};
}

}  // namespace

std::string to_table(const StepsResult& result) {
  const std::size_t width = width_of(result.rows, &StepsRow::scene);
  std::string table = fmt::format("{:<{}} {:<6} {:>7} {:>8} {:>6} {:>12} {:>10} {:>6} {:>8}\n", "scene", width, "device",
                                  "threads", "vertices", "bodies", "ms/step", "steps/s", "steps", "contacts");
  for (const StepsRow& row : result.rows)
    table += fmt::format("{:<{}} {:<6} {:>7} {:>8} {:>6} {:>12.4g} {:>10.4g} {:>6} {:>8}\n", row.scene, width,
                         name_of(row.device), threads_text(row.device, row.threads), row.vertices, row.bodies,
                         row.milliseconds_per_step, row.steps_per_second, row.steps, row.contact_steps);
  for (const std::string& note : result.notes) table += note + '\n';
  for (const FamilyCrossover& crossover : result.crossovers) table += to_text(crossover) + '\n';
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

std::string to_json(const Machine& machine, const StepsOptions& options, const StepsResult& result) {
  Json asked = options_json(options.devices, options.quick);
  asked.add("scenes", options.scenes.string());
  Json file = results_json("steps", machine, asked, result.interrupted, list_of(result.rows, row_json), result.notes);
  file.add("crossovers", list_of(result.crossovers, crossover_json));
  return text_of(file);
}

}  // namespace pliant::bench
