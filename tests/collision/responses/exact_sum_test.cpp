// Whole numbers of 64 bits in two halves, which contact adds impulses up in.
#include "physics/contact/exact_sum.glsl"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
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

// In fp32, which shaders have. They convert by halves. Numbers stand on both sides of where a low half turns its sign.
TEST_CASE("whole numbers in halves become floats and come from them, rounded as floats are") {
  for (const std::int64_t number : telling_numbers()) {
    CAPTURE(number);
    const auto exact = static_cast<double>(number);
    for (const float rounded : {physics32::real_of(in_halves(number)), physics32::real_by_halves(in_halves(number))})
      CHECK(std::abs(static_cast<double>(rounded) - exact) <= 0x1p-23 * std::abs(exact));
  }
  for (const float number :
       {0.0f, 1.0f, -1.0f, 5.25f, -5.25f, 0x1p31f, -0x1p31f, 0x1.fffffep30f, -0x1.fffffep30f, 0x1p32f, -0x1p32f, 0x1.8p32f,
        -0x1.8p32f, 0x1.fffffep31f, 0x1.fffffep32f, -0x1.fffffep32f, 0x1.234568p52f, -0x1.234568p60f}) {
    CAPTURE(number);
    const auto whole = static_cast<std::int64_t>(std::round(number));
    CHECK(physics32::halves_of_real(number) == in_halves(whole));
    CHECK(physics32::halves_by_halves(number) == in_halves(whole));
    CHECK(physics32::real_of(in_halves(whole)) == static_cast<float>(whole));
    CHECK(physics32::real_by_halves(in_halves(whole)) == static_cast<float>(whole));
  }
}

}  // namespace
}  // namespace pliant
