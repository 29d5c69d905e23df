// Which method serves best where a tolerance governs the steps and none is named.
#pragma once
#include "dynamics/integrator.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// For integrator = "auto". It estimates its error; `law` is none where no body is damped.
[[nodiscard]] const Integrator& automatic_integrator(double tolerance, DampingLaw law);

}  // namespace pliant
