// Records the dispatches of one step of an integrator, for every body together.
#pragma once
#include <vector>

#include "device/device_bodies.hpp"
#include "device/pass.hpp"
#include "dynamics/integrator.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

class Stepper {
 public:
  /// Expects allows_damping(integrator) unless the law is none. `device` and `bodies` must outlive the stepper.
  Stepper(Device& device, DeviceBodies& bodies, const Integrator& integrator, DampingLaw law, double time_step /* [s] */);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// The passes that take the state in `from_half` one step on, into the other half.
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t from_half) const;

 private:
  [[nodiscard]] std::vector<Pass> opening_passes(std::uint32_t from_half) const;
  [[nodiscard]] std::vector<Pass> runge_kutta_passes(std::uint32_t from_half) const;
  [[nodiscard]] std::vector<Pass> splitting_passes(const Splitting& method, std::uint32_t from_half) const;

  Device& device_;
  DeviceBodies& bodies_;
  const Integrator& integrator_;
  std::uint32_t law_;
  double time_step_;
  std::uint32_t stage_count_;
  DeviceArray<std::uint32_t> stages_;  // real4, two halves of a vertex each: displacements where forces are taken [m]
  DeviceArray<std::uint32_t> forces_;  // real4 a vertex: a splitting's kept spring forces [N]
  DeviceArray<double> accelerations_;  // [stage][vertex][3]
  DeviceArray<double> tableau_;
};

}  // namespace pliant
