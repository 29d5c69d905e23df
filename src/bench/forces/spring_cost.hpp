// Counts the instructions of a spring. With the measured multiply-adds per second, the count bounds the springs per second.
//
// One instruction is one arithmetic operation of a vector unit on all its lanes, and takes as long as a multiply-add. The table
// counts what physics/forces/spring.glsl asks for, with the differences before it and the accumulation after it:
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
// No kernel reaches its bound, because the count leaves out loads, loops, the maximum that keeps the root from zero, and sums of
// partial sums. It also leaves out the longer time of roots and divisions.
#pragma once
#include "device/cpu/spring_sums.hpp"

namespace pliant::bench {

struct InstructionCount {
  double all = 0;
  double multiply_adds = 0;  // included in `all`
};

/// The count for a pair if every vertex sums its own springs, as on the GPU and in the CPU's plain form.
inline constexpr InstructionCount instructions_of_pair{.all = 24, .multiply_adds = 12};

/// Returns the count for a pair if a spring is computed once for both its vertices, which are two pairs
/// (device/cpu/spring_tile.inc). A spring takes 27 instructions, 3 of them to accumulate a second time, and those that refine an
/// estimated root.
[[nodiscard]] InstructionCount instructions_of_pair_in_tiles(cpu::Isa isa, int precision);

/// Returns the most pairs per second for these multiply-adds per second. Without fused multiply-adds, each is two instructions.
[[nodiscard]] double bound_of_pairs_per_second(double multiply_adds_per_second, const InstructionCount& pair, bool fused);

}  // namespace pliant::bench
