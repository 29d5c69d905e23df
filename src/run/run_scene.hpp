// `pliant run`: simulates a scene and writes pictures and numbers.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/load_bodies.hpp"
#include "output/frames.hpp"
#include "ranks/ranks.hpp"
#include "run/choose_device.hpp"
#include "simulation/skipping.hpp"

namespace pliant {

inline constexpr int exit_failed = 5;                       // the simulation's numbers went wrong
inline constexpr double default_checkpoint_interval = 300;  // [s] of wall time

// Files that a run writes into its folder, besides frames.
inline constexpr const char* history_name = "history.csv";
inline constexpr const char* final_state_name = "final_state.csv";
inline constexpr const char* summary_name = "summary.json";
inline constexpr const char* output_names[] = {history_name, final_state_name, summary_name};

struct RunOptions {
  std::filesystem::path base;  // folder where relative `scene` and `out` start; empty: the current one
  std::filesystem::path scene;
  DeviceChoice device;
  std::optional<std::uint64_t> steps;
  std::optional<double> duration;   // [s]
  std::optional<double> time_step;  // [s]
  std::optional<double> tolerance;  // of a step's error, instead of time_step
  std::optional<std::string> integrator;
  std::vector<std::string> overrides;  // section.key=value
  std::filesystem::path out;           // empty: out/SCENE
  FrameFormat frames = FrameFormat::none;
  std::filesystem::path video;                // file to write instead of frames; empty: none
  std::filesystem::path checkpoint;           // file to write what the run can be resumed from; empty: none
  std::optional<double> checkpoint_interval;  // [s] of wall time
  /// Checkpoint to go on from, instead of a scene. Options of the scene and of frames then come from the checkpoint.
  std::filesystem::path resume;
  std::optional<std::string> scene_text;  // used instead of the scene file's content
  GivenMeshes meshes;                     // used instead of files and generators of these names
  bool timings = false;                   // measure each kind of pass
  Skipping skipping;                      // what steps leave out
  bool check = false;                     // validate and estimate only
  bool quiet = false;
};

/// Return the scene's file, and the folder where a run writes.
[[nodiscard]] std::filesystem::path scene_of(const RunOptions& options);
[[nodiscard]] std::filesystem::path folder_of(const RunOptions& options);

/// Returns the exit code: 0, exit_failed or exit_interrupted (interrupts.hpp). In each case it has written the results so
/// far. Throws Error. `ranks` make the run together, and rank 0 writes; on others it returns 0. If it fails on another rank, this
/// one may throw FailedElsewhere (together.hpp). What it throws before the ranks agree_to_end() leaves others waiting. Null: this
/// one is alone.
[[nodiscard]] int run_scene(const RunOptions& options, Ranks* ranks = nullptr);

}  // namespace pliant
