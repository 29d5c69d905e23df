// Which method, which step, how many of them, and at which of them frames fall.
#pragma once
#include <cstdint>
#include <optional>

#include "dynamics/integrator.hpp"
#include "model/model.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// Where a tolerance governs the steps the first one is so much of the bound, or one frame if that is shorter.
inline constexpr double first_step_fraction = 0.1;

/// Of what a strained body bears: the automatic step.
inline constexpr double automatic_step_safety = 0.9;

struct TimePlan {
  const Integrator* integrator = nullptr;
  double time_step = 0;                       // [s]; with a tolerance the first step, and the one after a contact
  double step_bound = 0;                      // largest stable step [s]; infinite where nothing bounds it
  std::uint64_t steps = 0;                    // none with a tolerance
  double frame_rate = 60;                     // [1/s]
  DampingLaw damping_law = DampingLaw::none;  // the scene's; none where no body has damping
  std::optional<double> tolerance = {};       // of a step's error (see PaceLimits); empty: steps are fixed
  double duration = 0;                        // [s], for which there is a tolerance

  /// Frame n is the first state at or after n / frame_rate. Steps beyond 1e18 count as 1e18.
  [[nodiscard]] std::uint64_t step_of_frame(std::uint64_t frame) const;
  /// The first step after `step` whose state is a frame: the next one where a step is longer than a frame.
  [[nodiscard]] std::uint64_t next_frame_step(std::uint64_t step) const;
  /// n / frame_rate [s], where a step ends exactly if there is a tolerance. Nothing after the duration.
  [[nodiscard]] std::optional<double> time_of_frame(std::uint64_t frame) const;
};

/// `steps` replaces the scene's duration. Throws Error, blaming the origin of the value, for an unknown integrator, for one that
/// cannot meet the scene's damping, has no room for its rates or can't estimate the error that the scene's tolerance is for, for
/// steps too long to resolve damping, for integrator = "auto" without a tolerance, for steps with one, and for a duration of more
/// than 3e8 steps. A scene's integrator that cannot meet the tolerance of --tolerance gives way to what "auto" takes.
[[nodiscard]] TimePlan plan_time(const SceneDescription& scene, const Model& model, std::optional<std::uint64_t> steps = {});

/// That steps can meet by this method with forces of so many bits.
[[nodiscard]] double smallest_tolerance(const Integrator& integrator, int precision);

/// Throws Error, blaming the tolerance's origin, if the plan's tolerance is below that.
void expect_carried(const SceneDescription& scene, const TimePlan& plan, int precision);

}  // namespace pliant
