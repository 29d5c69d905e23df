// Records the dispatches of one step of an integrator, for every body together.
#pragma once
#include <vector>

#include "device/pass.hpp"
#include "dynamics/forces/force.hpp"
#include "dynamics/integrator.hpp"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

class Stepper {
 public:
  /// How many different drags, that is damping rates times steps, the bodies may have where tableaus have to hold them. Expects
  /// no splitting.
  [[nodiscard]] static std::size_t most_drags(const Integrator& integrator);

  /// Expects allows_damping(integrator, law), and of a Nystrom method no more drags than most_drags. `bodies` and
  /// `added_forces`, if not null, must outlive the stepper. A method with stages takes each step's length from the bodies'
  /// frames, where `time_step` stands to begin with.
  Stepper(DeviceBodies& bodies, const Integrator& integrator, DampingLaw law, double time_step /* [s] */,
          Stages stages = Stages::of_result, const AddedForces* added_forces = nullptr);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// Once, before the first step.
  [[nodiscard]] std::vector<Pass> first_passes() const;
  /// The passes that take the state in `from_half` one step on, into the other half, and bound every body there.
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t from_half) const;
  /// After passes(): frames follow their bodies' rotation; then what is stated in them is restated. Either may run beside a pass
  /// that uses neither frames nor motions.
  [[nodiscard]] Pass following_pass(std::uint32_t from_half) const;
  [[nodiscard]] Pass restating_pass(std::uint32_t from_half) const;
  /// Sums the spring forces at the step's start, of bodies whose kept ones are stale. Part of a splitting's step.
  [[nodiscard]] Pass refresh_pass() const;

  [[nodiscard]] std::uint32_t stage_count() const { return stage_count_; }

 private:
  /// A method's tableau, or one for each rate of damping among the bodies.
  void use_tableaus(Stages stages);
  /// All stages: a pass each, or one where the bodies are small enough.
  using SlotOfStage = std::uint32_t (*)(std::uint32_t stage);
  [[nodiscard]] std::vector<Pass> stage_passes(std::string_view name, std::uint32_t from_half, SlotOfStage slot_of_stage) const;
  /// Set the forces beside the springs.
  [[nodiscard]] std::vector<Pass> added_passes(std::uint32_t slot) const;
  [[nodiscard]] std::uint32_t adds_force() const;
  [[nodiscard]] std::vector<Pass> splitting_passes(const Splitting& method, std::uint32_t from_half) const;

  DeviceBodies& bodies_;
  const AddedForces* added_forces_;
  const Integrator& integrator_;
  std::uint32_t law_;
  double time_step_;
  std::uint32_t stage_count_;
};

}  // namespace pliant
