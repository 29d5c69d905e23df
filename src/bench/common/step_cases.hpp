// What the suite `steps` runs: the scenes of a folder, and bodies of growing density in contact.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "simulation/time_plan.hpp"

namespace pliant::bench {

struct StepCase {
  std::string name;
  std::string family;  // of cases that differ by their density alone; empty for a scene as it is
  ModelAndState start;
  TimePlan plan;
  CollisionDescription collision;
  OutputDescription output;        // how it is seen
  std::uint64_t steps_before = 0;  // not measured: the first contacts
  std::uint64_t steps = 0;         // measured, at least one
};

struct StepCases {
  std::vector<StepCase> cases;     // families first, each from small to large
  std::vector<std::string> notes;  // what was left out, and why
};

/// Throws Error (command_line) where there is no such folder or it holds no scene.
void expect_scenes(const std::filesystem::path& folder);

/// Families come from two_spheres.toml and bunnies_undamped.toml where `folder` has them, with two bodies. `quick`: families of
/// small bodies alone. Throws Error: as expect_scenes, or input for a scene that is wrong.
[[nodiscard]] StepCases load_step_cases(const std::filesystem::path& folder, bool quick);

}  // namespace pliant::bench
