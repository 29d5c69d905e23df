// `pliant run`: a scene from file to pictures and numbers.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/frames.hpp"
#include "run/choose_device.hpp"

namespace pliant {

inline constexpr int exit_non_finite = 5;
inline constexpr double default_checkpoint_interval = 300;  // [s] of wall time

// What a run leaves in its folder, beside frames.
inline constexpr const char* history_name = "history.csv";
inline constexpr const char* final_state_name = "final_state.csv";
inline constexpr const char* summary_name = "summary.json";
inline constexpr const char* output_names[] = {history_name, final_state_name, summary_name};

struct RunOptions {
  std::filesystem::path base;  // folder that `scene` and `out` are in where they are relative; empty: the current one
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
  std::filesystem::path resume;  // such a file, instead of a scene; options of the scene and of frames are then the file's
  std::optional<std::string> scene_text;  // instead of what the scene's file holds
  bool timings = false;                   // of each kind of pass
  bool check = false;                     // validate and estimate only
  bool quiet = false;
};

/// The scene's file, and where a run writes.
[[nodiscard]] std::filesystem::path scene_of(const RunOptions& options);
[[nodiscard]] std::filesystem::path folder_of(const RunOptions& options);

/// Returns the exit code: 0, exit_non_finite or exit_interrupted (interrupts.hpp); what there is was written in each case. Throws
/// Error.
[[nodiscard]] int run_scene(const RunOptions& options);

}  // namespace pliant
