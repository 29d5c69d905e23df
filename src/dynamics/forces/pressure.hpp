// Pressure inside closed bodies: physics/forces/pressure.glsl.
#pragma once
#include "dynamics/forces/force.hpp"

namespace pliant {

[[nodiscard]] Force pressure();

}  // namespace pliant
