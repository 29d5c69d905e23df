// How steps fall into parts, and what follows from their lengths.
#include "physics/contact/parts.glsl"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

namespace pliant {
namespace {

using physics::StepParts;

TEST_CASE("kept impulses are scaled with the lengths of parts, by a factor of at most 16") {
  CHECK(physics::growth_of_kick(0, 1) == 1);  // there was no part
  CHECK(physics::growth_of_kick(1, 0.5) == 0.5);
  CHECK(physics::growth_of_kick(1e-6, 1) == 16);
}

TEST_CASE("steps that contact shortens are equal up to the target, and need no more than they must") {
  for (const double bound : {1.0, 0.999, 0.76, 0.5, 0.3, 1.0 / 3, 0.0101}) {
    CAPTURE(bound);
    StepParts parts = physics::before_first_part(1, /*divides=*/false);
    parts.longest = std::bit_cast<std::uint32_t>(static_cast<float>(bound));
    const double first = physics::next_part(parts, 1);
    int steps = 0;
    for (double left = 1; left > 0; ++steps) {
      parts.full = std::min(1.0, left);
      const double step = physics::next_part(parts, left);
      CHECK(step == Approx(first).epsilon(1e-9));
      left = left - step < 1e-12 ? 0 : left - step;
    }
    CHECK(first <= bound * (1 + 1e-6));
    CHECK(steps == static_cast<int>(std::ceil(1 / bound - 1e-6)));
  }
}

}  // namespace
}  // namespace pliant
