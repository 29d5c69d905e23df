// `pliant run --check`: estimates what a run would cost.
#pragma once
#include "run/prepared_run.hpp"

namespace pliant {

/// Prints bodies, steps, memory and an estimate of the time (step_cost.hpp). With a tolerance it runs the scene for a second to
/// see how long steps are. If one step takes longer than a second, it prints a lower bound instead.
void show_check(const PreparedRun& run);

}  // namespace pliant
