// What a run says of itself: on the way, at the end, and in its summary.
#pragma once
#include <optional>
#include <string>

#include "output/summary.hpp"
#include "run/checkpoint.hpp"
#include "run/prepared_run.hpp"

namespace pliant {

/// A run as far as it has come.
struct RunStatus {
  const RunOptions& options;
  PreparedRun& run;
  const RunProgress& progress;
  const StepReport& report;
};

/// What went wrong; a step beyond its bound is among the warnings from before the run.
[[nodiscard]] std::optional<std::string> instability_of(const RunStatus& status);

/// Counts the triangles that intersect at the end.
[[nodiscard]] Summary summary_of(const RunStatus& status);

/// Where a resumed run goes on.
void show_beginning(const RunStatus& status);
/// A bar, on a terminal.
void show_progress(const RunStatus& status);
void show_end(const RunStatus& status);

}  // namespace pliant
