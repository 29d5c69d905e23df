// Reports on a run: on the way, at the end, and in its summary.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Returns what the energy at the latest row of the history is above that of the start [J]. What scripted bodies give is no gain.
[[nodiscard]] double energy_gained(const RunProgress& progress);

/// Returns whether the run has to end because its energy has grown a thousandfold while its steps fall into ever more parts, and
/// to more than the energy_scale of its forces. Holds for the latest row of the history.
[[nodiscard]] bool has_blown_up(const RunStatus& status);

/// Describes a breakdown, or the largest growth of the energy in any row of the history, or returns nothing. A step beyond its
/// bound is already among the run's warnings.
[[nodiscard]] std::optional<std::string> instability_of(const RunStatus& status);

/// Returns what has made the energy grow by so much [J], and what to try against it. `by_lists` is what lists of clusters that
/// were made anew have changed it by [J], or NaN if nobody knows. `shorter` says what makes steps shorter.
[[nodiscard]] std::string cause_of_growth(double gained, double by_lists, const StepReport& report, std::string_view shorter);

/// Says how often contact by impulses held bodies or cut motions of vertices short, a text each, if that was often.
/// `moving_vertices` are those of all bodies that are not static. docs/output.md says how often is often.
[[nodiscard]] std::vector<std::string> contact_troubles_of(const StepReport& report, std::uint64_t moving_vertices,
                                                           int precision);
[[nodiscard]] std::vector<std::string> contact_troubles_of(const RunStatus& status);
/// Tells of clustered bodies whose forces were far off, and of those that went over to sums of all springs.
[[nodiscard]] std::vector<std::string> cluster_troubles_of(const RunStatus& status);

/// Returns the summary. Unless there was a breakdown, it searches for the triangles that intersect at the end.
[[nodiscard]] Summary summary_of(const RunStatus& status);

/// Prints where a resumed run goes on.
void show_beginning(const RunStatus& status);
/// Draws a progress bar if standard error is a terminal.
void show_progress(const RunStatus& status);
void show_end(const RunStatus& status);

}  // namespace pliant
