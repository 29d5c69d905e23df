#include "bench/forces/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

Json row_json(const ForcesRow& row) {
  return {{"device", name_of(row.device)},
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

// A sum can only be faster than its bound if the machine was slower when the bound was measured.
std::vector<std::string> notes_of(const ForcesResult& result) {
  std::vector<std::string> notes = result.notes;
  if (std::ranges::any_of(result.rows, [](const ForcesRow& row) { return row.ratio_to_bound > 1; }))
    notes.emplace_back("the machine was busy: it fell short of its own multiply-adds, as ratios above 1 show; measure again");
  return notes;
}

}  // namespace

std::string to_table(const ForcesResult& result) {
  const std::size_t width = width_of(result.rows, &ForcesRow::variant);
  std::string table = fmt::format("{:<6} {:>4} {:>7}  {:<{}} {:>8} {:>12} {:>13} {:>13} {:>7}\n", "device", "bits", "threads",
                                  "variant", width, "vertices", "us a sum", "pairs/s", "bound", "ratio");
  for (const ForcesRow& row : result.rows)
    table += fmt::format("{:<6} {:>4} {:>7}  {:<{}} {:>8} {:>12.2f} {:>13.4g} {:>13.4g} {:>7.3f}\n", name_of(row.device),
                         row.precision, threads_text(row.device, row.threads), row.variant, width, row.vertices,
                         1e6 * row.seconds_per_evaluation, row.pairs_per_second, row.bound_pairs_per_second, row.ratio_to_bound);
  for (const std::string& note : notes_of(result)) table += note + '\n';
  return table;
}

std::string to_json(const Machine& machine, const ForcesOptions& options, const ForcesResult& result) {
  Json asked = options_json(options.devices, options.quick);
  asked.add("all_variants", options.all_variants);
  return text_of(results_json("forces", machine, asked, result.interrupted, list_of(result.rows, row_json), notes_of(result)));
}

}  // namespace pliant::bench
