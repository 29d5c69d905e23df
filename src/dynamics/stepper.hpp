// Records the dispatches of one step of an integrator, for every body together.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "device/pass.hpp"
#include "dynamics/clusters/cluster_forces.hpp"
#include "dynamics/forces/force.hpp"
#include "dynamics/integrator.hpp"
#include "dynamics/internal_damping.hpp"
#include "dynamics/shared_sums.hpp"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

class Stepper {
 public:
  /// Returns how many different drags the bodies may have if tableaus have to hold them. A drag is a damping rate times the step.
  /// Expects no splitting.
  [[nodiscard]] static std::size_t most_drags(const Integrator& integrator);

  /// Expects allows_damping(integrator, law), and for a Nystrom method no more drags than most_drags. `bodies` must outlive the
  /// stepper. Makes the arrays of all forces that act on the model. A method with stages takes each step's length from the
  /// bodies' `control`, which begins with `time_step`. Throws Error (input) if several ranks need more tableaus than there is
  /// room for.
  Stepper(DeviceBodies& bodies, const Model& model, const Integrator& integrator, DampingLaw law, double time_step /* [s] */,
          Stages stages = Stages::of_result);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// Sums the springs of clustered bodies from here on as these say, one for each body. Where it is null, as the model says.
  /// Passes that were recorded before do not hold any more. Throws Error (input), and changes nothing, if lists would be too
  /// long. Throws Error (device) if there is no room for them. Then sums have to be changed again before the next step.
  void change_sums(const Model& model, const std::vector<std::shared_ptr<const ChangedSums>>& changed);
  /// Returns the trees that lists of clusters are made of.
  [[nodiscard]] ClusterTrees& cluster_trees() { return cluster_trees_; }
  /// Returns the sums of clustered bodies, or null if there are none.
  [[nodiscard]] const ClusterForces* cluster_forces() const { return cluster_forces_ ? &*cluster_forces_ : nullptr; }

  /// Returns the passes that run once, before the first step.
  [[nodiscard]] std::vector<Pass> first_passes() const;
  /// Returns the passes that take the state in `from_half` one step on, into the other half, and bound every body there.
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t from_half) const;
  /// The first makes frames follow their bodies' rotation, and the second restates what is stated in them. They run after
  /// passes(). Either may run beside a pass that uses neither frames nor motions.
  [[nodiscard]] Pass following_pass(std::uint32_t from_half) const;
  [[nodiscard]] Pass restating_pass(std::uint32_t from_half) const;
  /// Sums the spring forces at the step's start, for bodies whose kept ones are stale. It is part of a splitting's step, unless
  /// one pass makes all of the step.
  [[nodiscard]] std::vector<Pass> refresh_passes() const;

  /// Whether it can make quiet steps (physics/quiet.glsl).
  [[nodiscard]] bool makes_quiet_steps() const;
  /// Returns the pass that makes quiet steps, the first of them from this half. Other passes have set bounds for it. `span` says
  /// which kind.
  [[nodiscard]] Pass quiet_pass(std::uint32_t first_half, ForceSpan span) const;
  /// Returns how many work groups make quiet steps, at most. They take the shares of bodies that move.
  [[nodiscard]] std::uint32_t quiet_group_count() const;

  /// Whether the method keeps spring forces for the next step.
  [[nodiscard]] bool keeps_force() const { return staged_method(integrator_) == nullptr; }
  [[nodiscard]] std::uint32_t stage_count() const { return stage_count_; }

 private:
  /// Makes the method's tableau, or one for each rate of damping among the bodies.
  void use_tableaus(Stages stages);
  using StateOfStage = std::function<StageState(std::uint32_t stage)>;
  /// Returns a pass for each stage, or one for all stages if the bodies are small enough and springs are their only forces.
  /// `of_all_stages` is for passes of the second kind.
  [[nodiscard]] std::vector<Pass> stage_passes(std::string_view name, std::uint32_t from_half, const StateOfStage& state_of_stage,
                                               const Parameters& of_all_stages = {}) const;
  /// Has all sums given, if several ranks simulate together. Clustered bodies are those whose flag is set.
  void share_sums(const Model& model, const std::vector<bool>& are_clustered);
  /// Returns passes that make the sums that are given: those of clustered bodies, and those that ranks share. ClusterForces says
  /// what the arguments are.
  [[nodiscard]] std::vector<Pass> sum_passes(std::uint32_t slot, bool only_stale) const;
  /// Returns passes that set the forces beside the springs, for one stage.
  [[nodiscard]] std::vector<Pass> force_passes(const StageState& at) const;
  [[nodiscard]] std::uint32_t adds_force() const { return added_forces_.any() || internal_damping_.acts() ? 1 : 0; }
  [[nodiscard]] std::vector<Pass> splitting_passes(const Splitting& method, std::uint32_t from_half) const;
  [[nodiscard]] Parameters first_kick_and_drift(const Splitting& method) const;
  /// Whether one pass makes all forces and stages of a step, for each force group.
  [[nodiscard]] bool makes_a_step_in_one_pass() const;

  DeviceBodies& bodies_;
  ClusterTrees cluster_trees_;
  std::optional<ClusterForces> cluster_forces_;  // empty: no body is clustered
  std::optional<SharedSums> shared_sums_;        // empty: this rank is alone
  // Where each body's tableau begins, if it cancels rounding, and if it does not. Where a body needs only one, both are that.
  // Empty for splittings.
  std::vector<std::uint32_t> cancelling_rows_, plain_rows_;
  AddedForces added_forces_;
  InternalDamping internal_damping_;
  const Integrator& integrator_;
  std::uint32_t law_;  // as kernels of stages know it
  double time_step_;
  std::uint32_t stage_count_ = 0;
};

}  // namespace pliant
