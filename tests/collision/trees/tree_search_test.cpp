// How searches are cut for many bodies. kernels_test and oracle_test have what they find.
#include "collision/trees/tree_search.hpp"

#include <catch2/catch.hpp>

namespace pliant {
namespace {

TEST_CASE("searches are cut for all pairs of a few bodies, and never for fewer because there are more bodies") {
  for (std::uint32_t bodies = 0; bodies <= 6; ++bodies) {
    std::uint32_t pairs = 0;
    for (std::uint32_t a = 0; a < bodies; ++a) pairs += a;
    CHECK(pairs_expected(bodies) == std::max(pairs, 1u));
  }
  std::uint32_t before = 1;
  for (std::uint32_t bodies = 0; bodies < 200'000; ++bodies) {
    const std::uint32_t pairs = pairs_expected(bodies);
    if (pairs < before) FAIL(bodies << " bodies: " << pairs << " pairs");
    before = pairs;
  }
  CHECK(pairs_expected(~0u) == ~0u);
}

}  // namespace
}  // namespace pliant
