// What a step of a scene costs, found without making one that takes long.
#pragma once
#include <cstddef>

#include "run/prepared_run.hpp"

namespace pliant {

/// Time of a step in which every body is deformed [s]. A scene of few springs makes one. Else spheres of growing size do, until a
/// step takes 20 ms, and the cost goes by the number of springs: contacts are then left out.
[[nodiscard]] double seconds_per_step(const PreparedRun& run);

/// What the device holds, with what summing forces takes on a CPU.
[[nodiscard]] std::size_t bytes_of_run(const PreparedRun& run);

}  // namespace pliant
