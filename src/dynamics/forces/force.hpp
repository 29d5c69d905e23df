// The list of forces that act within a body. Energies, bounds on steps, reports and passes read its rows.
#pragma once
#include <any>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/thread_pool.hpp"
#include "device/pass.hpp"
#include "model/model.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// Records the passes that set a force beside the springs. Stages add it to the springs' forces.
class AddedForce {
 public:
  virtual ~AddedForce() = default;
  /// Returns passes that compute the forces at the placements in a slot. The last pass visits every vertex and calls add_force()
  /// (kernels/parts/add_force.glsl), which reads the kernel's parameter `is_first`.
  [[nodiscard]] virtual std::vector<Pass> passes(std::uint32_t slot, bool is_first) const = 0;
};

/// Whose energy is asked for. Once `stopped` returns true, the energy may be NaN. Several threads ask `stopped` at once. If it is
/// null, nobody stops the sum.
struct EnergyQuestion {
  const Model& model;
  const State& state;
  ThreadPool& pool;
  const std::function<bool()>& stopped;
  std::any& kept;  // what the force keeps until its next question about the same model. Empty before the first
};

/// A force within a body. The forces on a body's vertices add up to no force and no torque. Internal damping counts on that.
struct Force {
  std::string_view name;
  bool is_zero_at_rest;                    // a body in its rest shape feels nothing
  bool (*acts_on)(const ModelBody& body);  // is asked by feels()
  /// Returns the energy of all bodies together [J]. It has the same bits on any number of threads.
  double (*energy)(const EnergyQuestion& question);
  /// Returns an energy that is large for the body [J]: 1e-12 of it counts as rounding.
  double (*energy_scale)(const ModelBody& body);
  /// Returns the most that it adds to omega^2 of the stiffest small motion [1/s^2].
  double (*frequency_squared)(const ModelBody& body);
  /// Null for the springs, which force kernels sum themselves.
  std::unique_ptr<AddedForce> (*make)(DeviceBodies& bodies, const Model& model);
  /// Returns a text for each body that is beyond what frequency_squared holds for. It names the body and says what helps. A body
  /// gets the same text again at a later state, so that a run tells it once. Null if the force has nothing to tell.
  std::vector<std::string> (*warnings)(const Model& model, const State& state);
};

/// Returns whether the force acts on the body. Static bodies feel none.
[[nodiscard]] bool feels(const ModelBody& body, const Force& force);
/// Returns whether any body does.
[[nodiscard]] bool any_feels(const Model& model, const Force& force);

/// Returns all forces, the springs first.
[[nodiscard]] std::span<const Force> forces();
/// Adds another program's row. Simulations that are made from then on have it.
void add_force(const Force& force);

/// The forces beside the springs that act on any body of a scene. Makes their arrays, but not `added_force`, which the stepper
/// makes. Bodies that feel one at rest count as deformed.
class AddedForces {
 public:
  /// `bodies` must outlive this.
  AddedForces(DeviceBodies& bodies, const Model& model);
  [[nodiscard]] bool any() const { return !forces_.empty(); }
  /// Returns passes that set `added_force` at the placements in a slot.
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t slot) const;

 private:
  std::vector<std::unique_ptr<AddedForce>> forces_;
};

}  // namespace pliant
