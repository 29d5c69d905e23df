// The multiply-adds that the processor's vector units do at best: what sums of springs are measured against.
#pragma once
#include <cstdint>

#include "core/thread_pool.hpp"
#include "device/cpu/spring_sums.hpp"

namespace pliant::cpu {

/// Keeps every thread of the pool busy with independent chains of multiply-adds in the instruction set's vectors, some tens of
/// microseconds each, and returns how many there were, lane by lane. `precision` 32 or 64.
std::uint64_t run_multiply_adds(ThreadPool& pool, Isa isa, int precision);

/// Whether a multiply-add is one instruction there; else it is a multiplication and an addition.
[[nodiscard]] bool fuses_multiply_adds(Isa isa);

}  // namespace pliant::cpu
