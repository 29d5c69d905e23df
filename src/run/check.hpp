// `pliant run --check`: what a run would take, without running it.
#pragma once
#include "run/prepared_run.hpp"

namespace pliant {

/// Prints bodies, steps, memory and an estimate of the time. Steps the scene a little for that.
void show_check(PreparedRun& run);

}  // namespace pliant
