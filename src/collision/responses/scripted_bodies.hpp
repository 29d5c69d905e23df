// Bodies that go along paths. Forces and impulses do not move them. In each step they go whole, or wait where proofs stop them.
#pragma once
#include <cstdint>
#include <vector>

#include "device/pass.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// What a scripted body did since the start.
struct ScriptReport {
  std::uint32_t body = 0;   // its index in the model
  double time = 0;          // on its path's own clock [s]
  double waited = 0;        // while that clock stood [s]
  std::uint32_t waits = 0;  // parts of steps in which it waited

  bool operator==(const ScriptReport&) const = default;
};

/// Records the passes of a step that move scripted bodies. There are none without such bodies.
class ScriptedBodies {
 public:
  ScriptedBodies(const DeviceBodies& bodies, const Model& model);

  [[nodiscard]] bool is_empty() const { return scripted_.empty(); }
  /// Return passes of a step, in this order:
  /// - Bounding adds to the bounds of bodies' velocities, before they bound the step.
  /// - Following finds where paths lead, when flights are known and before motions are expected.
  /// - Moving goes there, in place of the integrator.
  /// - Ending comes when the step is settled.
  [[nodiscard]] std::vector<Pass> bounding_passes() const;
  [[nodiscard]] std::vector<Pass> following_passes() const;
  [[nodiscard]] std::vector<Pass> moving_passes(std::uint32_t from_half) const;
  [[nodiscard]] std::vector<Pass> ending_passes(const Parameters& capacities) const;
  /// Returns one for each scripted body. Waits for the queued steps.
  [[nodiscard]] std::vector<ScriptReport> report() const;

 private:
  const DeviceBodies& bodies_;
  std::vector<std::uint32_t> scripted_;  // indices of bodies
};

}  // namespace pliant
