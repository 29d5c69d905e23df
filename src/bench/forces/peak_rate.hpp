// Measures the most multiply-adds a second of a device.
#pragma once
#include <optional>

#include "bench/common/place.hpp"
#include "bench/common/timing.hpp"
#include "device/cpu/spring_sums.hpp"

namespace pliant::bench {

/// Returns multiply-adds per second of the fastest batch [1/s], counted lane by lane. The CPU uses the place's threads and
/// precision and the given instruction set. The GPU uses fp32. `device` must be the place's and must be idle.
[[nodiscard]] double multiply_adds_per_second(Device& device, const Place& place, std::optional<cpu::Isa> isa,
                                              const Effort& effort);

}  // namespace pliant::bench
