// Plans a run's time: the integrator, the length and number of its steps, and the steps that are frames.
#pragma once
#include <cstdint>
#include <optional>

#include "dynamics/integrator.hpp"
#include "model/model.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// With a tolerance the first step is this part of the step bound, or one frame if that is shorter.
inline constexpr double first_step_fraction = 0.1;

/// The automatic step is at most this part of the largest step that a strained body bears.
inline constexpr double automatic_step_safety = 0.9;

struct TimePlan {
  const Integrator* integrator = nullptr;
  double time_step = 0;                       // [s]; with a tolerance: the first step, and the longest after a contact
  double step_bound = 0;                      // largest stable step [s]; infinite: nothing bounds it
  std::uint64_t steps = 0;                    // 0 with a tolerance
  double frame_rate = 60;                     // [1/s]
  DampingLaw damping_law = DampingLaw::none;  // the scene's law, or none if no body has damping
  std::optional<double> tolerance = {};       // of a step's error (see PaceLimits); empty: steps are fixed
  double duration = 0;                        // [s]; used with a tolerance
  bool sleep = false;                         // whether bodies that rest on something stop to move

  /// Returns the step of frame n: the first one that ends at or after n / frame_rate. It is at most 1e18.
  [[nodiscard]] std::uint64_t step_of_frame(std::uint64_t frame) const;
  /// Returns the first step after `step` whose state is a frame. If steps are longer than frames, that is the next step.
  [[nodiscard]] std::uint64_t next_frame_step(std::uint64_t step) const;
  /// Returns n / frame_rate [s], or nothing if that is after the duration. With a tolerance a step ends exactly there.
  [[nodiscard]] std::optional<double> time_of_frame(std::uint64_t frame) const;
};

/// Returns the damping law that a scene names, or its default by response and gravity.
[[nodiscard]] DampingLaw damping_law_of(const SceneDescription& scene);

/// Chooses the integrator and the steps for a scene. `steps` replaces the scene's duration. If the scene's integrator cannot meet
/// the tolerance of --tolerance, the plan takes the one that "auto" chooses.
/// Throws Error, which names the origin of the value, for
/// - an unknown response, or one that does not allow the scene's static bodies, grounds or search
/// - an unknown integrator, or "auto" without a tolerance
/// - an integrator that cannot meet the scene's damping, or has no room for its damping rates
/// - an integrator that can't estimate the error, if the scene has a tolerance
/// - steps too long to resolve damping
/// - `steps` with a tolerance
/// - a duration of more than 3e8 steps.
[[nodiscard]] TimePlan plan_time(const SceneDescription& scene, const Model& model, std::optional<std::uint64_t> steps = {});

/// Returns the smallest tolerance that steps of this method can meet with forces of `precision` bits.
[[nodiscard]] double smallest_tolerance(const Integrator& integrator, int precision);

/// Throws Error, which names the tolerance's origin, if the plan's tolerance is below smallest_tolerance.
void expect_carried(const SceneDescription& scene, const TimePlan& plan, int precision);

}  // namespace pliant
