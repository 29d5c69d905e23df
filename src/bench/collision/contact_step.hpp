// Measures by its passes what a step in contact by impulses costs, for two spheres that press each other.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/common/place.hpp"

namespace pliant::bench {

/// Passes of contact by impulses (docs/step.md) that a figure sums.
struct PassGroup {
  std::string_view name;
  std::vector<std::string_view> passes;
};
/// Returns them in the order of a step. All passes for two bodies are in one of them.
[[nodiscard]] std::span<const PassGroup> contact_groups();

/// The members' names are the keys of the file. Times are of a part of a step, medians over the parts that were made.
struct ContactStepRow {
  DeviceKind device = DeviceKind::cpu;
  unsigned threads = 1;                                      // of the CPU; null in the file for the GPU
  std::uint32_t triangles = 0;                               // of each of the two bodies
  std::size_t pressing_contacts = 0;                         // that gave an impulse in the last part
  std::vector<std::pair<std::string, double>> seconds = {};  // of each group. `refit` has the key `refit_seconds`
  double step_seconds = 0;                                   // of all passes, springs and integrator as well
  std::string breakdown = {};  // empty (null in the file) if none. Bodies that broke down cost nothing
};

/// Lets spheres of `icosphere:level` go on from pressed_spheres by `verlet`, for 15 parts. Three are enough with `quick`, and
/// once ten seconds have passed. Throws Error (device).
[[nodiscard]] ContactStepRow measure_contact_step(const Place& place, int level, bool quick);

}  // namespace pliant::bench
