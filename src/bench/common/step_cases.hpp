// Loads what the suite `steps` runs: the scenes of a folder, and bodies of growing density in contact.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "device/device.hpp"
#include "model/model.hpp"
#include "simulation/time_plan.hpp"

namespace pliant::bench {

struct StepCase {
  std::string name;
  std::string family;  // name of cases that differ only by their density; empty for a scene as it is
  ModelAndState start;
  TimePlan plan;
  CollisionDescription collision;
  OutputDescription output;        // camera and size of its pictures
  std::uint64_t steps_before = 0;  // steps to the first contacts, which are not measured
  std::uint64_t steps = 0;         // measured steps, at least one
};

struct StepCases {
  std::vector<StepCase> cases;     // families first, each from small to large
  std::vector<std::string> notes;  // what was left out, and why
};

/// Settles which bodies of the cases are clustered on such a device, as a run does.
void choose_force_sums(StepCases& all, DeviceKind device);
[[nodiscard]] std::uint32_t clustered_bodies(const Model& model);

/// Throws Error (command_line) if there is no such folder, or it holds no scene.
void expect_scenes(const std::filesystem::path& folder);

/// Loads the scenes of a folder. Families come from its two_spheres.toml and bunnies_undamped.toml, if they have two bodies. With
/// `quick` families have only small bodies. Throws Error: as expect_scenes, or input for a scene that is wrong.
[[nodiscard]] StepCases load_step_cases(const std::filesystem::path& folder, bool quick);

}  // namespace pliant::bench
