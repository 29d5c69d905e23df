// The order of one step.
#pragma once
#include <vector>

#include "collision/collider.hpp"
#include "dynamics/pacer.hpp"
#include "dynamics/stepper.hpp"

namespace pliant {

/// Returns the passes of one step in order, from `from_half` into the other half. If `pacer` is null, the step has a fixed
/// length.
[[nodiscard]] std::vector<Pass> step_passes(const DeviceBodies& bodies, const Stepper& stepper, const Collider& collider,
                                            std::uint32_t from_half, const Pacer* pacer);

}  // namespace pliant
