#include "bench/forces/spring_cost.hpp"

#include <catch2/catch.hpp>

#include "physics/language.glsl"

// Includes the spring's own source once more, with numbers that count what is done to them.
namespace pliant::counted {

struct Operations {
  int all = 0, multiply_adds = 0, maxima = 0;
};
Operations operations;

// What is done to constants alone does not count, because a compiler folds it. Signs are part of an instruction.
struct Number {
  explicit Number(int) : constant(true) {}
  Number(bool is_constant) : constant(is_constant) {}
  bool constant;
};

Number count(int& kind, bool constant) {
  if (!constant) ++kind;
  return {constant};
}
Number operator-(Number a) { return a; }
Number operator-(Number a, Number b) { return count(operations.all, a.constant && b.constant); }
Number operator*(Number a, Number b) { return count(operations.all, a.constant && b.constant); }
Number operator/(Number a, Number b) { return count(operations.all, a.constant && b.constant); }
Number inversesqrt(Number a) { return count(operations.all, a.constant); }
Number max(Number a, Number b) { return count(operations.maxima, a.constant && b.constant); }
Number fused(Number a, Number b, Number c) {
  const bool constant = a.constant && b.constant && c.constant;
  count(operations.multiply_adds, constant);
  return count(operations.all, constant);
}

struct Vector {
  Number x, y, z;
  Vector(Number first, Number second, Number third) : x(first), y(second), z(third) {}
};
using real = Number;
using real3 = Vector;
const Number real_epsilon(1);

}  // namespace pliant::counted

#undef REAL_BEGIN
#define REAL_BEGIN namespace pliant::counted {
#undef FUSED
#define FUSED(a, b, c) fused(a, b, c)
#include "physics/forces/spring.glsl"

namespace pliant::bench {
namespace {

counted::Operations operations_of_strain() {
  const counted::Number variable(false);
  const counted::Vector vector(variable, variable, variable);
  counted::operations = {};
  CHECK_FALSE(counted::spring_strain(vector, vector).constant);
  return counted::operations;
}

TEST_CASE("the table of a pair's instructions counts what the spring's source asks for") {
  const counted::Operations strain = operations_of_strain();
  const int differences = 6, accumulation = 3;  // around it: differences of two vertices' places, and a multiply-add a coordinate
  CHECK(instructions_of_pair.all == strain.all + differences + accumulation);
  CHECK(instructions_of_pair.multiply_adds == strain.multiply_adds + accumulation);
  CHECK(strain.maxima == 1);  // the table leaves it out
}

TEST_CASE("a bound of pairs follows from the multiply-adds a second and the instructions of a pair") {
  constexpr InstructionCount pair{.all = 20, .multiply_adds = 8};
  CHECK(bound_of_pairs_per_second(20e9, pair, true) == Approx(1e9));
  // Unfused, a pair needs 12 + 2 * 8 instructions, and 14e9 multiply-adds are 28e9 instructions.
  CHECK(bound_of_pairs_per_second(14e9, pair, false) == Approx(1e9));
}

TEST_CASE("a spring computed for both its vertices costs each less, refinement included") {
  for (const cpu::Isa isa : {cpu::Isa::portable, cpu::Isa::avx2, cpu::Isa::avx512})
    for (const int precision : {32, 64}) {
      const InstructionCount count = instructions_of_pair_in_tiles(isa, precision);
      CHECK(count.all < instructions_of_pair.all);
      CHECK(count.multiply_adds < count.all);
    }
  CHECK(instructions_of_pair_in_tiles(cpu::Isa::avx512, 64).all > instructions_of_pair_in_tiles(cpu::Isa::avx512, 32).all);
}

}  // namespace
}  // namespace pliant::bench
