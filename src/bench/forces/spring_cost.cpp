#include "bench/forces/spring_cost.hpp"

namespace pliant::bench {
namespace {

// Counts a spring in a tile. Three of a pair's 12 multiply-adds are subtractions here (x - h, h = d / 2). One more is in the
// product, and three more accumulate.
constexpr InstructionCount instructions_of_spring{.all = 27, .multiply_adds = 13};

// Root and division are one instruction each, instead of the 3 for inverse square root, reciprocal and product. But the root
// needs an absolute value. With AVX-512 it is estimated and refined: see quarter_strain in device/cpu/spring_sums_avx512.cpp.
InstructionCount refinement(cpu::Isa isa, int precision) {
  if (isa != cpu::Isa::avx512) return {};
  return precision == 32 ? InstructionCount{.all = 2, .multiply_adds = 1} : InstructionCount{.all = 5, .multiply_adds = 4};
}

}  // namespace

InstructionCount instructions_of_pair_in_tiles(cpu::Isa isa, int precision) {
  const InstructionCount refining = refinement(isa, precision);
  return {.all = (instructions_of_spring.all + refining.all) / 2,
          .multiply_adds = (instructions_of_spring.multiply_adds + refining.multiply_adds) / 2};
}

double bound_of_pairs_per_second(double multiply_adds_per_second, const InstructionCount& pair, bool fused) {
  const double per_multiply_add = fused ? 1 : 2;
  return multiply_adds_per_second * per_multiply_add / (pair.all + (per_multiply_add - 1) * pair.multiply_adds);
}

}  // namespace pliant::bench
