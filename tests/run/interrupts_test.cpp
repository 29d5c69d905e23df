// What the program takes for a second Ctrl-C.
#include "run/interrupts.hpp"

#include <catch2/catch.hpp>

namespace pliant {

TEST_CASE("a second Ctrl-C counts from a second after the first on, and not before") {
  using namespace std::chrono_literals;
  for (const std::chrono::nanoseconds after : {0ns, 1ns, 500'000'000ns, 999'999'999ns}) CHECK_FALSE(is_another_interrupt(after));
  for (const std::chrono::nanoseconds after : {1'000'000'000ns, 1'000'000'001ns, 3'600'000'000'000ns})
    CHECK(is_another_interrupt(after));
}

}  // namespace pliant
