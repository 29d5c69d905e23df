// The order of one step.
#pragma once
#include <vector>

#include "collision/collider.hpp"
#include "dynamics/pacer.hpp"
#include "dynamics/stepper.hpp"

namespace pliant {

/// One step in order, from `from_half` into the other. A null pacer: a step of fixed length.
[[nodiscard]] std::vector<Pass> step_passes(const DeviceBodies& bodies, const Stepper& stepper, const Collider& collider,
                                            std::uint32_t from_half, const Pacer* pacer);

}  // namespace pliant
