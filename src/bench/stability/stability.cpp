#include "bench/stability/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/stability/tasks.hpp"

namespace pliant::bench {
namespace {

constexpr double agreement = 0.02;  // relative distance of a measured limit to its prediction, up to which they agree

template <class Row>
std::vector<Row> rows_of(const StabilityResult& result) {
  std::vector<Row> rows;
  for (const StabilityRow& row : result.rows)
    if (const auto* found = std::get_if<Row>(&row)) rows.push_back(*found);
  return rows;
}

bool is_small_and_undamped(const LimitRow& row) { return row.damping == 0 && row.amplitude == small_amplitude; }

std::string limits_note(const std::vector<LimitRow>& rows) {
  double worst = 0;
  std::size_t count = 0;
  for (const LimitRow& row : rows)
    if (is_small_and_undamped(row) && row.measured_step) {
      worst = std::max(worst, std::abs(*row.measured_step / row.predicted_step - 1));
      ++count;
    }
  return fmt::format("undamped limits at small amplitude: {} measured, the farthest {:.2f} % from the predicted one", count,
                     100 * worst);
}

std::string map_note(const std::vector<MapRow>& rows) {
  std::size_t within = 0, failed = 0, beyond = 0, survived = 0;
  for (const MapRow& row : rows) {
    const bool is_within = row.time_step <= row.predicted_bound;
    const bool blew_up = row.outcome == Outcome::blown_up;
    within += is_within;
    failed += is_within && blew_up;
    beyond += !is_within;
    survived += !is_within && !blew_up;
  }
  return fmt::format("map: of {} cells within the predicted bound {} blew up; of {} beyond it {} did not", within, failed, beyond,
                     survived);
}

std::vector<std::string> notes_of(const StabilityResult& result) {
  std::vector<std::string> notes;
  if (const auto rows = rows_of<LimitRow>(result); !rows.empty()) {
    notes.push_back(limits_note(rows));
    for (const LimitRow& row : rows)
      if (is_small_and_undamped(row) && (!row.measured_step || std::abs(*row.measured_step / row.predicted_step - 1) > agreement))
        notes.push_back(fmt::format("{}, {} vertices, fp{}: the limits differ by more than 2 %", row.integrator, row.vertices,
                                    row.precision));
  }
  if (const auto rows = rows_of<MapRow>(result); !rows.empty()) notes.push_back(map_note(rows));
  return notes;
}

}  // namespace

StabilityResult bench_stability(const StabilityOptions& options, const Progress& progress) {
  StabilityDevices devices(options.devices);
  StabilityTasks tasks(options.quick, devices);
  add_limits(tasks);
  add_maps(tasks);
  add_drifts(tasks);
  add_errors(tasks);
  double total = 0, done = 0;
  for (const StabilityTask& task : tasks.all()) total += task.cost;
  StabilityResult result;
  for (const StabilityTask& task : tasks.all()) {
    result.interrupted = !progress(done / total, task.name);
    if (result.interrupted) break;
    result.rows.push_back(task.measure());
    done += task.cost;
  }
  if (!result.interrupted) progress(1, "");
  result.notes = notes_of(result);
  return result;
}

}  // namespace pliant::bench
