// The forces that act within a body: a list. Energies, bounds on steps, reports and passes read its rows.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/thread_pool.hpp"
#include "device/pass.hpp"
#include "model/model.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// Records what sets forces beside the springs, which stages add to them.
class AddedForce {
 public:
  virtual ~AddedForce() = default;
  /// Forces at the placements in a slot. The last pass visits every vertex and calls add_force() (kernels/parts/add_force.glsl);
  /// `is_first` is its parameter.
  [[nodiscard]] virtual std::vector<Pass> passes(std::uint32_t slot, bool is_first) const = 0;
};

/// Whose energy is asked for. Once `stopped` answers true (several threads ask at once) it may be NaN; null: nobody stops it.
struct EnergyQuestion {
  const Model& model;
  const State& state;
  ThreadPool& pool;
  const std::function<bool()>& stopped;
};

struct Force {
  std::string_view name;
  bool is_zero_at_rest;  // a body in its rest shape feels nothing
  bool (*acts_on)(const ModelBody& body);
  /// Of all bodies together [J]. The same bits on any number of threads.
  double (*energy)(const EnergyQuestion& question);
  /// An energy that counts as much of the body's [J]: 1e-12 of it is rounding.
  double (*energy_scale)(const ModelBody& body);
  /// What it adds to omega^2 of the stiffest small motion, at most [1/s^2].
  double (*frequency_squared)(const ModelBody& body);
  /// Null for the springs, which force kernels sum themselves.
  std::unique_ptr<AddedForce> (*make)(DeviceBodies& bodies, const Model& model);
  /// Says that a body is beyond what frequency_squared holds for, and what helps. Null where it holds everywhere.
  std::optional<std::string> (*warning)(const Model& model, const State& state);
};

/// The springs first.
[[nodiscard]] std::span<const Force> forces();
/// Adds a row of another program's. Simulations that are made from then on have it.
void add_force(const Force& force);

/// The forces beside the springs that act on any body of a scene. Makes their arrays; bodies that feel one at rest count as
/// deformed.
class AddedForces {
 public:
  /// `bodies` must outlive this.
  AddedForces(DeviceBodies& bodies, const Model& model);
  [[nodiscard]] bool any() const { return !forces_.empty(); }
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t slot) const;

 private:
  std::vector<std::unique_ptr<AddedForce>> forces_;
};

}  // namespace pliant
