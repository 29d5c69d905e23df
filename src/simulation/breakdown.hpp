// Why a simulation ended, and what may help, in words.
#pragma once
#include <string>

#include "simulation/simulation.hpp"

namespace pliant {

/// "<what happened> in step <n> at vertex <v> of body "<name>"; <remedy>".
[[nodiscard]] std::string describe_breakdown(const NonFinite& where, const TimePlan& plan, const Model& model);

}  // namespace pliant
