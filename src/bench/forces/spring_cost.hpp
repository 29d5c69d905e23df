// What a spring costs in instructions. With the multiply-adds a second measured, it bounds the springs a second.
//
// One instruction is one arithmetic operation of a vector unit on all its lanes, for one multiply-add's share of its time.
// Counted is what physics/forces/spring.glsl asks for, with differences before and accumulation behind:
//
//   operation                                 all  multiply-adds among them
//   differences: displacement d, position x     6      0
//   e = 2 x - d                                 3      3
//   growth = d.e                                3      2
//   |x|^2                                       3      3
//   product |x|^2 (|x|^2 - growth)              2      0
//   inverse square root                         1      0
//   denominator                                 1      1
//   reciprocal, times growth                    2      0
//   accumulation                                3      3
//   together                                   24     12
//
// Loads, loops, the maximum that keeps the root from zero, sums of partial sums and the longer time of roots and divisions are
// left out, so no kernel reaches its bound.
#pragma once
#include "device/cpu/spring_sums.hpp"

namespace pliant::bench {

struct InstructionCount {
  double all = 0;
  double multiply_adds = 0;  // among them
};

/// Of one vertex with one other, where every vertex sums its own springs: GPU, and the CPU's plain form.
inline constexpr InstructionCount instructions_of_pair{.all = 24, .multiply_adds = 12};

/// Where a spring is computed once and counts for both its vertices, which are two pairs (device/cpu/spring_tile.inc): 27 a
/// spring, 3 of them to accumulate once more, and what an estimated root has to be refined with.
[[nodiscard]] InstructionCount instructions_of_pair_in_tiles(cpu::Isa isa, int precision);

/// Pairs a second at most, where `multiply_adds_per_second` are possible. Without fused multiply-adds, one is two instructions.
[[nodiscard]] double bound_of_pairs_per_second(double multiply_adds_per_second, const InstructionCount& pair, bool fused);

}  // namespace pliant::bench
