// A scene made ready to run: loaded, built and planned, with the command line's changes applied.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/stopwatch.hpp"
#include "device/device.hpp"
#include "run/run_scene.hpp"
#include "simulation/simulation.hpp"

namespace pliant {

struct PreparedRun {
  std::filesystem::path working_folder;  // that relative places are in; empty if it had gone at the start
  std::string scene_text;
  SceneDescription scene;
  std::vector<std::uint64_t> mesh_checksums;  // of each body's vertices and triangles
  ModelAndState start;
  TimePlan plan;
  std::unique_ptr<Device> device;
  std::unique_ptr<Simulation> simulation;
  std::vector<std::string> warnings;
  Stopwatch load_time, build_time;
};

/// It must not move, since its simulation refers to its model. Throws Error. Warnings tell of meshes, of a step beyond the
/// stability bound and of bodies that overlap at the start.
[[nodiscard]] std::unique_ptr<PreparedRun> prepare_run(const RunOptions& options);

}  // namespace pliant
