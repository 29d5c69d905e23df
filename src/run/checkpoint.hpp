// Saves a run in a checkpoint and resumes it from there.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/stopwatch.hpp"
#include "output/file_lock.hpp"
#include "run/prepared_run.hpp"
#include "simulation/measure.hpp"

namespace pliant {

/// Where the wall time goes.
struct RunTimes {
  Stopwatch loading, building, stepping, measuring, writing, saving;
};

/// What a run knows besides its simulation.
struct RunProgress {
  std::uint64_t recorded_steps = 0;  // steps at the latest row of the history
  double recorded_time = 0;          // of that row [s]: within a step, if the run was ended between its parts
  std::uint64_t next_frame = 1;      // with a tolerance: the frame that steps lead to
  std::uint64_t frames_written = 0;  // number of frames
  Measurement first, latest;         // of the start, and of the latest row
  double largest_drift = 0;          // of the energy [J]
  double most_in_motion = 0;         // largest kinetic and elastic energy [J]
  double most_of_gravity = 0;        // largest change of the gravitational energy since the start [J]
  double work_of_scripts = 0;        // at the latest row [J]
  double most_work_of_scripts = 0;   // its largest size [J]
  double most_gained = 0;            // at a row of the history: what energy_gained says [J]
  double time_of_gain = 0;           // of that row [s]
  RunTimes times;                    // includes the run's parts before it was resumed
};

struct Checkpoint {
  std::string version;                   // of pliant, with its commit
  RunOptions options;                    // those the run was begun with, but with the kind and precision of its device
  std::filesystem::path working_folder;  // where relative paths in the options start
  std::string device_name;
  std::string scene_text;
  std::vector<std::uint64_t> mesh_checksums;  // one a body
  std::vector<std::string> warnings;
  RunProgress progress;
  std::string history;     // history.csv
  std::string simulation;  // Simulation::save
};

[[nodiscard]] Checkpoint checkpoint_of(const RunOptions& options, PreparedRun& run, const RunProgress& progress,
                                       const std::string& history);

[[nodiscard]] std::string to_bytes(const Checkpoint& checkpoint);
/// Throws Error (input) if bytes are missing or too many.
[[nodiscard]] Checkpoint checkpoint_from(std::string_view bytes);

/// What a run goes on from.
struct Resumed {
  Checkpoint checkpoint;
  std::unique_ptr<FileLock> lock;  // of the checkpoint's file, held since before it was read; null: the run writes elsewhere
};

/// Reads the file that `given` resumes. Throws Error: command_line while another run writes it, input if it is not a checkpoint.
[[nodiscard]] Resumed load_resumed(const RunOptions& given);

/// An option that is allowed together with --resume. All others are refused.
struct OptionBesideResume {
  std::string_view name;
  void (*take)(RunOptions& run, const RunOptions& given);  // overwrites the run's value if `given` has one
};
[[nodiscard]] std::span<const OptionBesideResume> options_beside_resume();

/// Returns the options of the resumed run: those it was begun with, with the changes that `given` makes beside --resume. Relative
/// paths start in the folder in which the run was begun, or in the current one if that is gone.
[[nodiscard]] RunOptions resumed_options(const RunOptions& given, const Checkpoint& checkpoint);

/// Puts the prepared run into the checkpoint's state and gives it the checkpoint's warnings. Throws Error: input if a mesh has
/// changed, device if this is another device, because the bits would differ. If `given` names a device, that is only a warning.
void resume(const RunOptions& given, const Checkpoint& checkpoint, PreparedRun& run);

/// Knows when a checkpoint is due, and writes it.
class CheckpointKeeper {
 public:
  /// Reserves the file that the options name, with `lock` or with a lock of its own. Does nothing if they name none. Throws Error
  /// (command_line) if the file can't be written, is in use by another run, or is an output of this run.
  CheckpointKeeper(const RunOptions& options, std::unique_ptr<FileLock> lock);

  [[nodiscard]] bool is_wanted() const { return !file_.empty(); }
  [[nodiscard]] bool is_due() const { return is_wanted() && Clock::now() - latest_ >= interval_; }
  /// Writes a checkpoint, and returns whether it could. If not, it warns once for each reason. The run goes on, and the
  /// checkpoint before it stays.
  bool write(const Checkpoint& checkpoint);

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path file_;
  std::unique_ptr<FileLock> lock_;
  bool has_one_;         // the file is a checkpoint of this run
  std::string problem_;  // why the latest one was not written; empty: it was
  std::chrono::duration<double> interval_;
  Clock::time_point latest_ = Clock::now();
};

}  // namespace pliant
