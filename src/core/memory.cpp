#include "core/memory.hpp"

#include <cstdlib>
#include <limits>

namespace pliant {

bool is_memory_given(std::uint64_t bytes) {
  if (bytes > std::numeric_limits<std::size_t>::max() / 2) return false;
  void* volatile memory = std::malloc(bytes);  // volatile, or the compiler may leave both calls out
  const bool is_given = memory != nullptr;
  std::free(memory);
  return is_given;
}

}  // namespace pliant
