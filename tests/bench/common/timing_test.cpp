// Clocks of the tests' own, so that times are known.
#include "bench/common/timing.hpp"

#include <catch2/catch.hpp>
#include <chrono>

namespace pliant::bench {
namespace {

TEST_CASE("the median is the middle value, or the mean of the two middle ones") {
  CHECK(median({3}) == 3);
  CHECK(median({9, 1, 2}) == 2);
  CHECK(median({9, 1, 2, 4}) == 3);
}

TEST_CASE("short work is repeated until looks at the clock don't count") {
  const double look = 1e-5, work = 1e-6;
  CHECK(seconds_each({}, [&](std::uint64_t count) { return look + work * static_cast<double>(count); }).median ==
        Approx(work).epsilon(1e-3));
}

TEST_CASE("one slow batch changes neither the median nor the fastest") {
  int batches = 0;
  const Timing each = seconds_each({}, [&](std::uint64_t) { return ++batches == 3 ? 0.5 : 0.03; });
  CHECK(each.median == Approx(0.03));
  CHECK(each.fastest == Approx(0.03));
}

TEST_CASE("long work is done four times in all") {
  std::uint64_t done = 0;
  const auto take = [&](std::uint64_t count) {
    done += count;
    return 2.0 * static_cast<double>(count);
  };
  CHECK(seconds_each({}, take).median == 2);
  CHECK(done == 4);
}

TEST_CASE("what is slow until it has been under load for a while is timed after that") {
  double passed = 0;
  const auto take = [&](std::uint64_t count) {
    const double seconds = (passed < 0.25 ? 5e-3 : 1e-3) * static_cast<double>(count);
    passed += seconds;
    return seconds;
  };
  CHECK(seconds_each({}, take, 0.3).median == Approx(1e-3));
  CHECK(passed < 0.6);  // all in all: no more load than it takes
  passed = 0;
  CHECK(seconds_each({}, take).median == Approx(5e-3));
}

TEST_CASE("work on a device takes some time by its own clock") {
  const auto device = make_cpu_device(1, 32);
  int calls = 0;
  const auto last_a_tick = [&] {
    using Clock = std::chrono::steady_clock;
    for (const Clock::time_point start = Clock::now(); Clock::now() == start;) continue;
    ++calls;
  };
  CHECK(seconds_each(*device, {.batch_seconds = 0, .batches = 3}, last_a_tick).median > 0);
  CHECK(calls == 4);  // one that warms up, as any batch is long enough
}

}  // namespace
}  // namespace pliant::bench
