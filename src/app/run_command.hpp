// `pliant run`: a scene from file to pictures and numbers.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/choose_device.hpp"
#include "output/frames.hpp"

namespace pliant::app {

inline constexpr int exit_non_finite = 5;

struct RunOptions {
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
  bool timings = false;  // of each kind of pass
  bool check = false;    // validate and estimate only
  bool quiet = false;
};

/// Returns the exit code: 0, exit_non_finite or exit_interrupted (interrupts.hpp); what there is was written in each case. Throws
/// Error.
[[nodiscard]] int run(const RunOptions& options);

}  // namespace pliant::app
