// Sums the squared elongations of a vertex's springs in fp64, in the vectors of an instruction set.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>

#include "device/cpu/spring_sums.hpp"

namespace pliant {

/// Returns (|x| - L)^2 [m^2] of a spring, without cancellation. `rest` leads from one end to the other at rest, and `change` is
/// its change, so that x = rest + change. Then it is (|x|^2 - L^2)^2 / (|x| + L)^2, and |x|^2 - L^2 = change . (rest + x). One
/// factor is divided before the other comes in, so that only an energy beyond all numbers overflows.
[[nodiscard]] double elongation_squared(const glm::dvec3& rest, const glm::dvec3& change);

/// How many springs are summed side by side. The order of additions follows from it, so every instruction set has the same.
inline constexpr std::size_t elongation_lanes = 8;

/// Where all vertices are, with one array per coordinate. Arrays have elongation_lanes more numbers behind the last vertex. They
/// are read, but count for nothing.
struct SpringEnds {
  const double *rest[3], *moved[3];  // rest positions and displacements [m]
};

/// Returns the sum of (|x| - L)^2 [m^2] over the springs from vertex `i` to the vertices from `i` + 1 to before `end`.
using ElongationSum = double (*)(const SpringEnds& at, std::size_t i, std::size_t end);

/// Returns the sum for an instruction set that is available. The bits are the same for all.
[[nodiscard]] ElongationSum elongation_sum(cpu::Isa isa);

}  // namespace pliant
