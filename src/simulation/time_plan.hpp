// Which method, which step, how many of them, and at which of them frames fall.
#pragma once
#include <cstdint>
#include <optional>

#include "dynamics/integrator.hpp"
#include "model/model.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

struct TimePlan {
  const Integrator* integrator = nullptr;
  double time_step = 0;   // [s]
  double step_bound = 0;  // largest stable step [s]; infinite where nothing bounds it
  std::uint64_t steps = 0;
  double frame_rate = 60;                     // [1/s]
  DampingLaw damping_law = DampingLaw::none;  // the scene's; none where no body has damping

  /// Frame n is the first state at or after n / frame_rate. Steps beyond 1e18 count as 1e18.
  [[nodiscard]] std::uint64_t step_of_frame(std::uint64_t frame) const;
};

/// `steps` replaces the scene's duration. Throws Error (fault_of the scene's `where`) for an unknown integrator, for one that
/// cannot meet the scene's damping, and for a duration of more than 3e8 steps.
[[nodiscard]] TimePlan plan_time(const SceneDescription& scene, const Model& model, std::optional<std::uint64_t> steps = {});

}  // namespace pliant
