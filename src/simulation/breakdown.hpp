// Says in words why a simulation ended and what may help.
#pragma once
#include <string>

#include "simulation/simulation.hpp"

namespace pliant {

/// Returns "<what happened> in step <n> at vertex <v> of body "<name>"; <remedy>". If there is pressure in that body, it says
/// that its volume may have come to zero or grown without end.
[[nodiscard]] std::string describe_breakdown(const Breakdown& where, const TimePlan& plan, const Model& model);

}  // namespace pliant
