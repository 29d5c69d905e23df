// The multiply-adds a second that a device does at best.
#pragma once
#include <optional>

#include "bench/common/place.hpp"
#include "bench/common/timing.hpp"
#include "device/cpu/spring_sums.hpp"

namespace pliant::bench {

/// By the fastest batch. On the CPU with the place's threads and precision in the given instruction set; on the GPU in fp32.
/// `device` is the place's, without work in hand. [1/s], counted lane by lane.
[[nodiscard]] double multiply_adds_per_second(Device& device, const Place& place, std::optional<cpu::Isa> isa,
                                              const Effort& effort);

}  // namespace pliant::bench
