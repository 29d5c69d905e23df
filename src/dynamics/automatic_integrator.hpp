// Says which method serves best if a tolerance governs the steps and no method is named.
#pragma once
#include "dynamics/integrator.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// Returns the method for integrator = "auto". It estimates its error. `law` is none if no body is damped.
[[nodiscard]] const Integrator& automatic_integrator(double tolerance, DampingLaw law);

}  // namespace pliant
