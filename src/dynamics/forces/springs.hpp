// Springs between every two vertices of a body: physics/forces/spring.glsl.
#pragma once
#include "dynamics/forces/force.hpp"

namespace pliant {

[[nodiscard]] Force springs();

}  // namespace pliant
