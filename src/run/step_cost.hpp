// Estimates what a step of a scene costs, without making one that takes long.
#pragma once
#include <cstddef>

#include "run/prepared_run.hpp"

namespace pliant {

/// Returns the time of a step in which every body is deformed [s]. If the scene has few springs that are summed one by one,
/// it times a step of the scene. Else it times spheres of growing size until a step takes 20 ms, and scales by the number of such
/// springs. If that is more than half a second, it is the answer, which leaves out all else, clusters too. If not, it times a
/// step of the scene.
[[nodiscard]] double seconds_per_step(const PreparedRun& run);

/// Returns the device's memory [bytes]. For a CPU it includes the scratch memory for summing forces.
[[nodiscard]] std::size_t bytes_of_run(const PreparedRun& run);

}  // namespace pliant
