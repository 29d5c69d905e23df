// One function serves every instruction set: the compiler makes vectors of its lanes, once for each. Nothing is contracted or
// reordered, so the bits are the same.
#include "dynamics/forces/elongations.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#define PLIANT_INLINE inline __attribute__((always_inline))

namespace pliant {
namespace {

// `now` is |x|^2, `before` L^2, and `growth` |x|^2 - L^2.
PLIANT_INLINE double elongation_squared(double now, double before, double growth) {
  constexpr double least = std::numeric_limits<double>::min();  // so that two vertices that share a place in both shapes give 0
  return growth * (growth / (now + before + 2 * std::sqrt(now * before) + least));
}

PLIANT_INLINE double elongation_squared(const SpringEnds& at, std::size_t i, std::size_t j) {
  double now = 0, rest = 0, growth = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double r = at.rest[axis][i] - at.rest[axis][j], d = at.moved[axis][i] - at.moved[axis][j], x = r + d;
    now += x * x;
    rest += r * r;
    growth += d * (r + x);
  }
  return elongation_squared(now, rest, growth);
}

// The last lanes may be beyond `end`. What they compute is dropped.
PLIANT_INLINE double sum_in_lanes(const SpringEnds& at, std::size_t i, std::size_t end) {
  constexpr std::size_t lanes = elongation_lanes;
  double sums[lanes] = {};
  for (std::size_t j = i + 1; j < end; j += lanes) {
    double each[lanes];
    for (std::size_t lane = 0; lane < lanes; ++lane) each[lane] = elongation_squared(at, i, j + lane);
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += lane < end - j ? each[lane] : 0.0;
  }
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

double sum_portable(const SpringEnds& at, std::size_t i, std::size_t end) { return sum_in_lanes(at, i, end); }
#ifdef PLIANT_X86_TILES
__attribute__((target("avx2"))) double sum_avx2(const SpringEnds& at, std::size_t i, std::size_t end) {
  return sum_in_lanes(at, i, end);
}
#endif

}  // namespace

double elongation_squared(const glm::dvec3& rest, const glm::dvec3& change) {
  const glm::dvec3 x = rest + change;
  return elongation_squared(glm::dot(x, x), glm::dot(rest, rest), glm::dot(change, rest + x));
}

// Most of the time goes into divisions and roots. AVX-512 makes no more of them in a cycle than AVX2.
ElongationSum elongation_sum(cpu::Isa isa) {
#ifdef PLIANT_X86_TILES
  if (isa != cpu::Isa::portable) return &sum_avx2;
#endif
  return &sum_portable;
}

}  // namespace pliant
