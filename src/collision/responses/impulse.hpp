// Contact by impulses. Before a step, velocities are kicked so that no features come nearer than a gap. After it, each motion is
// proven to stay apart from its neighbours', or is cut short. docs/contact.md explains the method.
#pragma once
#include "collision/responses/response.hpp"

namespace pliant {

[[nodiscard]] ResponseRow impulse_row();

}  // namespace pliant
