// Does as many multiply-adds as the processor's vector units can. Sums of springs are measured against that.
#pragma once
#include <cstdint>

#include "core/thread_pool.hpp"
#include "device/cpu/spring_sums.hpp"

namespace pliant::cpu {

/// Keeps every thread of the pool busy with independent chains of multiply-adds in the instruction set's vectors. Threads take
/// them in tasks of some tens of microseconds. Returns how many multiply-adds there were, lane by lane. `precision` is 32 or 64.
std::uint64_t run_multiply_adds(ThreadPool& pool, Isa isa, int precision);

/// Returns whether a multiply-add is one instruction there. Otherwise it is a multiplication and an addition.
[[nodiscard]] bool fuses_multiply_adds(Isa isa);

}  // namespace pliant::cpu
