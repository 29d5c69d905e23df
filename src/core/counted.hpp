// Numbers of things in messages.
#pragma once
#include <cstddef>
#include <string>

namespace pliant {

/// Returns such as "1 vertex" or "2 vertices".
[[nodiscard]] inline std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace pliant
