// `pliant run --check`: what a run would take, without running it.
#pragma once
#include "run/prepared_run.hpp"

namespace pliant {

/// Prints bodies, steps, memory and an estimate of the time (step_cost.hpp). With a tolerance the scene is stepped for a second,
/// to see how long steps are, unless one takes longer than that.
void show_check(const PreparedRun& run);

}  // namespace pliant
