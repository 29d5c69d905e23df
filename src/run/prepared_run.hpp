// Makes a scene ready to run: loads, builds and plans it with the command line's changes.
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
  std::filesystem::path working_folder;  // where relative paths start; empty: it was gone at the start
  std::string scene_text;
  SceneDescription scene;
  std::vector<std::uint64_t> mesh_checksums;  // one a body, of its vertices and triangles
  ModelAndState start;
  TimePlan plan;
  std::unique_ptr<Device> device;
  std::unique_ptr<Simulation> simulation;
  std::vector<std::string> warnings;
  Stopwatch load_time, build_time;
};

/// Returns a run that must not move, because its simulation refers to its model. Throws Error, also if bodies intersect at the
/// start that the response keeps apart.
/// The run's warnings tell of
/// - flaws of meshes, and keys that change nothing
/// - an integrator that was replaced because it can't meet the tolerance
/// - a step beyond the stability bound, or no step at all
/// - bodies that intersect at the start, if the response does not keep them apart
/// - bodies that begin nearer than the gap, if the response keeps them apart
/// - masses that differ so much, or bodies so far out, that rounding harms contacts.
/// `ranks` simulate it together, and must outlive it. Null: this one is alone.
[[nodiscard]] std::unique_ptr<PreparedRun> prepare_run(const RunOptions& options, Ranks* ranks = nullptr);

}  // namespace pliant
