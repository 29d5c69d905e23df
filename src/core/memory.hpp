// Asks the system for memory before work begins.
#pragma once
#include <cstdint>

namespace pliant {

/// Returns whether the system gives so much memory at once, which it gets back untouched. Linux refuses more than the machine has
/// in all, unless it is told to promise any amount.
[[nodiscard]] bool is_memory_given(std::uint64_t bytes);

}  // namespace pliant
