// Damping that leaves a body's rigid motion alone: physics/rigid_motion.glsl.
#pragma once
#include <vector>

#include "device/pass.hpp"
#include "model/model.hpp"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// Where a stage finds the state that damping acts on.
struct StageState {
  std::uint32_t slot;    // of placements
  std::uint32_t half;    // of motions, for the velocities at a step's first stage
  std::uint32_t index;   // of the stage. Velocities of later stages of a method are in `acceleration`
  double kick_time = 0;  // [s] of a splitting's kick
};

/// Stages damp by the constant law. Passes before them add the forces that make it spare the bodies' rigid motions. Sums are in a
/// fixed order.
class InternalDamping {
 public:
  /// `bodies` must outlive this. Makes arrays only if a body has internal damping.
  InternalDamping(DeviceBodies& bodies, const Model& model, DampingLaw law);
  /// Returns whether any body has internal damping.
  [[nodiscard]] bool acts() const { return part_count_ > 0; }
  /// Returns passes that add to `added_force`, or set it if `is_first`. Returns none if no body needs them.
  [[nodiscard]] std::vector<Pass> passes(const StageState& at, bool is_first) const;

 private:
  const DeviceBodies& bodies_;
  std::uint32_t part_count_ = 0;
};

}  // namespace pliant
