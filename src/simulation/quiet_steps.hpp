// Makes steps in which contacts need no answer, many in one dispatch (physics/quiet.glsl). Bits are those of other steps. Contact
// by impulses foresees what bodies may reach. Responses that look at where steps end, and scenes in which nothing touches, give
// each body room of its own (kernels/give_room.glsl).
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "collision/collider.hpp"
#include "dynamics/stepper.hpp"

namespace pliant {

class QuietSteps {
 public:
  /// All must outlive it. If stepper or response do not know quiet steps, none is ever made.
  QuietSteps(DeviceBodies& bodies, const Stepper& stepper, const Collider& collider);

  [[nodiscard]] bool are_known() const { return !passes_[0].empty(); }
  /// The passes make steps from this half on until something may come near, at most as many as aim_at() said.
  void aim_at(std::uint64_t most) const;
  [[nodiscard]] const std::vector<Pass>& passes(std::uint32_t from_half) const { return passes_[from_half]; }
  /// Returns how many they made. Waits for them. If the device does not run all their groups at once, they made none, and none
  /// are known from here on.
  [[nodiscard]] std::uint32_t take_made();

 private:
  std::uint32_t most_at_once_ = 0;
  DeviceArray<physics::QuietSteps>* steps_ = nullptr;
  std::array<std::vector<Pass>, 2> passes_;  // by the half that the first step starts from
};

}  // namespace pliant
