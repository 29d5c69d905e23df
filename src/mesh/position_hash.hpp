// Hashes positions, for tables of vertices and of cells.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace pliant {

/// Equal positions have equal hashes, and so have 0 and -0. Any bits of a hash serve as well as others.
[[nodiscard]] inline std::size_t hash_of(const glm::dvec3& position) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(position[axis] + 0.0)) * 0x9e3779b97f4a7c15;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace pliant
