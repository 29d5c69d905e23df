#include "core/thread_pool.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

namespace pliant {
namespace {

TEST_CASE("every item of a loop is visited exactly once, on any number of threads") {
  for (const unsigned threads : {1u, 2u, 7u}) {
    ThreadPool pool(threads);
    CHECK(pool.size() == threads);
    for (const std::uint32_t count : {0u, 1u, 15u, 16u, 17u, 1000u, 65537u}) {
      std::vector<int> visits(count, 0);
      pool.for_ranges(count, 16, [&](std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t i = first; i < end; ++i) ++visits[i];
      });
      CHECK(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
    }
  }
}

TEST_CASE("loops follow each other without waiting for their stragglers' next turn") {
  ThreadPool pool(4);
  std::vector<std::uint64_t> sums(64, 0);
  for (std::uint64_t loop = 1; loop <= 2000; ++loop)
    pool.for_ranges(64, 1, [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t i = first; i < end; ++i) sums[i] += loop;
    });
  for (const std::uint64_t sum : sums) CHECK(sum == 2000ull * 2001 / 2);
}

}  // namespace
}  // namespace pliant
