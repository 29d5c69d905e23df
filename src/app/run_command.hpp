// `pliant run`, alone or as one of several MPI ranks.
#pragma once
#include "run/run_scene.hpp"

namespace pliant::app {

/// Returns the exit code. Throws Error, also if MPI has started several ranks of a program that was built without it.
[[nodiscard]] int run(const RunOptions& options);

}  // namespace pliant::app
