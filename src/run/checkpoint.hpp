// What a run can be taken up from, and when it is written.
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

/// What a run knows beside its simulation.
struct RunProgress {
  std::uint64_t recorded_steps = 0;  // of the latest row of the history
  std::uint64_t next_frame = 1;      // that steps of adaptive length go for
  std::uint64_t frames_written = 0;  // files
  Measurement first, latest;         // of the state, at the start and in the latest row
  double largest_drift = 0;          // of the energy [J]
  double most_in_motion = 0;         // kinetic and elastic [J]
  RunTimes times;                    // of all parts of a run that was resumed
};

struct Checkpoint {
  std::string version;                   // of pliant, with its commit
  RunOptions options;                    // as the run was begun, but for its device, which is the one that it had
  std::filesystem::path working_folder;  // that their relative places are in
  std::string device_name;
  std::string scene_text;
  std::vector<std::uint64_t> mesh_checksums;  // by body
  std::vector<std::string> warnings;
  RunProgress progress;
  std::string history;     // history.csv
  std::string simulation;  // Simulation::save
};

[[nodiscard]] Checkpoint checkpoint_of(const RunOptions& options, PreparedRun& run, const RunProgress& progress,
                                       const std::string& history);

[[nodiscard]] std::string to_bytes(const Checkpoint& checkpoint);
/// Throws Error (input) where bytes are missing or too many.
[[nodiscard]] Checkpoint checkpoint_from(std::string_view bytes);

/// What a run goes on from.
struct Resumed {
  Checkpoint checkpoint;
  std::unique_ptr<FileLock> lock;  // of its file, where the run goes on writing there; from before it was read on
};

/// Reads the file that `given` resumes. Throws Error: command_line while another run writes it, input when it is no checkpoint.
[[nodiscard]] Resumed load_resumed(const RunOptions& given);

/// An option that may stand beside --resume; any other one is refused.
struct OptionBesideResume {
  std::string_view name;
  void (*take)(RunOptions& run, const RunOptions& given);  // puts what is given, if it is, for what the run was begun with
};
[[nodiscard]] std::span<const OptionBesideResume> options_beside_resume();

/// The options by which the run goes on that `given` resumes: those it was begun with, but for those beside --resume. Relative
/// places are in the folder that the run was begun in, or in this one where that is gone.
[[nodiscard]] RunOptions resumed_options(const RunOptions& given, const Checkpoint& checkpoint);

/// Puts the prepared run where the checkpoint stood, with the warnings that it had. Throws Error: input, when a mesh has changed;
/// device, when the bits would differ because this is another device, unless `given` names one; then that is a warning.
void resume(const RunOptions& given, const Checkpoint& checkpoint, PreparedRun& run);

/// When a checkpoint is due, and how it is written.
class CheckpointKeeper {
 public:
  /// Does nothing unless the options name a file, which is then this run's alone: by `lock`, or by one that it makes. Throws
  /// Error (command_line) when it can't be written, is another run's, or an output of this one.
  CheckpointKeeper(const RunOptions& options, std::unique_ptr<FileLock> lock);

  [[nodiscard]] bool is_wanted() const { return !file_.empty(); }
  [[nodiscard]] bool is_due() const { return is_wanted() && Clock::now() - latest_ >= interval_; }
  /// Where it can't be written the run goes on, and the checkpoint before stays. A warning says so, once for one reason.
  void write(const Checkpoint& checkpoint);

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path file_;
  std::unique_ptr<FileLock> lock_;
  bool has_one_;         // of this run
  std::string problem_;  // of the latest one; empty: none
  std::chrono::duration<double> interval_;
  Clock::time_point latest_ = Clock::now();
};

}  // namespace pliant
