// What a CPU thread adds and appends in its items of a loop.
#define REAL_BITS 32
#include "device/cpu/kernel_prelude.inc"

#include <catch2/catch.hpp>
#include <vector>

REAL_BEGIN
namespace {

TEST_CASE("a thread's tallies are added at the end, to more totals than it keeps, too") {
  std::vector<uint> totals = {5, 0, 7, 0};
  {
    Tallies<uint, 2> tallies;
    for (int k = 0; k < 3; ++k)
      for (uint& total : totals) tallies.add(total, 10);
    CHECK(totals[0] == 5);  // kept
    CHECK(totals[3] == 30);
  }
  CHECK(totals == std::vector<uint>{35, 30, 37, 30});
}

TEST_CASE("tallies of whole numbers in halves carry, and may be negative") {
  std::vector<uvec2> totals(3, halves_of(-7.0));
  {
    Tallies<uvec2, 2> tallies;
    for (uvec2& total : totals) {
      for (int k = 0; k < 3; ++k) tallies.add(total, halves_of(4e9));
      tallies.add(total, halves_of(-2e10));
    }
  }
  for (const uvec2& total : totals) CHECK(whole_of(total) == 3 * 4e9 - 2e10 - 7);
}

TEST_CASE("what a thread appends comes into the list once, and is counted beyond its capacity") {
  constexpr uint values = 200, capacity = 150;
  std::vector<uvec2> list(values), other(values);
  uint count = 0, other_count = 3;
  {
    Appended appended;
    for (uint k = 0; k < values; ++k) {
      appended.add(list.data(), count, capacity, uvec2(k + 1, 0));
      if (k % 50 == 0) appended.add(other.data(), other_count, values, uvec2(0, k + 1));
    }
  }
  CHECK(count == values);
  CHECK(other_count == 3 + 4);
  for (uint k = 0; k < values; ++k) {
    CHECK(list[k] == (k < capacity ? uvec2(k + 1, 0) : uvec2(0)));
    CHECK(other[k] == (k >= 3 && k < 7 ? uvec2(0, 50 * (k - 3) + 1) : uvec2(0)));
  }
}

}  // namespace
REAL_END
