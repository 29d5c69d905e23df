// Whole numbers of 64 bits in two halves, which contact adds impulses up in.
#include "physics/contact/exact_sum.glsl"

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

namespace pliant {
namespace {

// Both sides of every carry, and of zero.
std::vector<std::int64_t> telling_numbers() {
  std::vector<std::int64_t> numbers;
  for (const std::int64_t at : {std::int64_t{0}, std::int64_t{1} << 31, std::int64_t{1} << 32, std::int64_t{1} << 52})
    for (const std::int64_t beside : {-1, 0, 1}) {
      numbers.push_back(at + beside);
      numbers.push_back(-at + beside);
    }
  return numbers;
}

glm::uvec2 in_halves(std::int64_t number) { return std::bit_cast<glm::uvec2>(number); }

TEST_CASE("whole numbers in halves add, turn and become doubles as integers of 64 bits do") {
  for (const std::int64_t a : telling_numbers()) {
    CAPTURE(a);
    CHECK(physics::negative_of(in_halves(a)) == in_halves(-a));
    CHECK(physics::whole_of(in_halves(a)) == static_cast<double>(a));
    CHECK(physics::halves_of(static_cast<double>(a)) == in_halves(a));
    for (const std::int64_t b : telling_numbers()) {
      CAPTURE(b);
      CHECK(physics::sum_of(in_halves(a), in_halves(b)) == in_halves(a + b));
    }
  }
}

}  // namespace
}  // namespace pliant
