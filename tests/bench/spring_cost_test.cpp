#include "bench/spring_cost.hpp"

#include <catch2/catch.hpp>

namespace pliant::bench {
namespace {

TEST_CASE("the pairs a second that multiply-adds allow follow from the instructions of a pair") {
  CHECK(instructions_of_pair.all == 24);  // see the table in spring_cost.hpp
  CHECK(instructions_of_pair.multiply_adds == 12);
  CHECK(bound_of_pairs_per_second(24e9, instructions_of_pair, true) == Approx(1e9));
}

TEST_CASE("without fused multiply-adds each is two instructions") {
  // 18e9 multiplications and as many additions a second, 12 + 2 * 12 instructions a pair
  CHECK(bound_of_pairs_per_second(18e9, instructions_of_pair, false) == Approx(1e9));
}

TEST_CASE("a spring computed for both its vertices costs each less, refinement included") {
  for (const cpu::Isa isa : {cpu::Isa::portable, cpu::Isa::avx2, cpu::Isa::avx512})
    for (const int precision : {32, 64}) {
      const InstructionCount count = instructions_of_pair_in_tiles(isa, precision);
      CHECK(count.all >= 27.0 / 2);
      CHECK(count.all < instructions_of_pair.all);
      CHECK(count.multiply_adds < count.all);
    }
  CHECK(instructions_of_pair_in_tiles(cpu::Isa::avx512, 64).all > instructions_of_pair_in_tiles(cpu::Isa::avx512, 32).all);
}

}  // namespace
}  // namespace pliant::bench
