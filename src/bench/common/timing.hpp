// Measures how long something takes on a device, by the device's own clock.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "device/device.hpp"

namespace pliant::bench {

/// Repetitions are timed in batches, so that reading the clock does not count.
struct Effort {
  double batch_seconds = 0.02;  // least length of a batch
  int batches = 5;              // once `enough_seconds` have passed, three are enough
  double enough_seconds = 1;
  double gpu_load_seconds = 0.3;  // before a GPU is timed: an idle H200 has lowered its clock to a sixth
};

/// Times of one repetition [s].
struct Timing {
  double median = 0;   // over the batches
  double fastest = 0;  // of all batches, because other load can only slow a batch down
};

/// The effort of `--quick`, which gives figures of the right size in a fraction of a second.
inline constexpr Effort quick_effort{.batch_seconds = 0.002, .batches = 3, .enough_seconds = 0.05, .gpu_load_seconds = 0};

/// Expects at least one value.
[[nodiscard]] double median(std::vector<double> values);

/// Runs so many repetitions and returns their time [s].
using BatchTimer = std::function<double(std::uint64_t repetitions)>;

/// Times batches. First it runs some repetitions that warm up and find out how many make a batch, for `load_seconds` at least.
[[nodiscard]] Timing seconds_each(const Effort& effort, const BatchTimer& seconds_of_batch, double load_seconds = 0);
/// Returns how long the device has to be busy before it is timed [s].
[[nodiscard]] double load_seconds(const Device& device, const Effort& effort);
/// Times calls of `queue`, which queues work on the device. A GPU has a load before, as the effort says.
[[nodiscard]] Timing seconds_each(Device& device, const Effort& effort, const std::function<void()>& queue);

}  // namespace pliant::bench
