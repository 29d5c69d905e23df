// How long something takes on a device, by the device's own clock.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "device/device.hpp"

namespace pliant::bench {

/// Repetitions are timed in batches, so that looks at the clock don't count.
struct Effort {
  double batch_seconds = 0.02;  // at least
  int batches = 5;              // at least; but once `enough_seconds` have passed, three do
  double enough_seconds = 1;
};

/// Of one repetition [s].
struct Timing {
  double median = 0;   // over the batches
  double fastest = 0;  // batch: whatever else the machine does can only slow it down
};

/// For `--quick`: figures of the right size, in a fraction of a second.
inline constexpr Effort quick_effort{.batch_seconds = 0.002, .batches = 3, .enough_seconds = 0.05};

/// Expects at least one.
[[nodiscard]] double median(std::vector<double> values);

/// Time of so many repetitions [s].
using BatchTimer = std::function<double(std::uint64_t repetitions)>;

/// After some repetitions that warm up and find out how many make a batch.
[[nodiscard]] Timing seconds_each(const Effort& effort, const BatchTimer& seconds_of_batch);
/// Of calls of `queue`, which queues work on the device.
[[nodiscard]] Timing seconds_each(Device& device, const Effort& effort, const std::function<void()>& queue);

}  // namespace pliant::bench
