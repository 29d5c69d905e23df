#include "bench/common/timing.hpp"

#include <algorithm>
#include <cmath>

#include "core/expect.hpp"

namespace pliant::bench {
namespace {

// Returns a number of repetitions that makes a batch long enough.
std::uint64_t repetitions_of_batch(double batch_seconds, const BatchTimer& seconds_of_batch) {
  std::uint64_t repetitions = 1;
  for (;;) {
    const double seconds = seconds_of_batch(repetitions);
    if (seconds >= batch_seconds) return repetitions;
    const double factor = std::clamp(1.2 * batch_seconds / std::max(seconds, 1e-9), 1.5, 16.0);
    repetitions = static_cast<std::uint64_t>(std::ceil(factor * static_cast<double>(repetitions)));
  }
}

}  // namespace

double median(std::vector<double> values) {
  PLIANT_EXPECT(!values.empty());
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Timing seconds_each(const Effort& effort, const BatchTimer& seconds_of_batch, double load_seconds) {
  double loaded = 0;
  const BatchTimer load = [&](std::uint64_t count) {
    const double seconds = seconds_of_batch(count);
    loaded += seconds;
    return seconds;
  };
  std::uint64_t repetitions = repetitions_of_batch(effort.batch_seconds, load);
  if (loaded < load_seconds) {
    while (loaded < load_seconds) load(repetitions);
    repetitions = repetitions_of_batch(effort.batch_seconds, load);  // which take less time now
  }
  std::vector<double> batches;
  double passed = 0;
  while (batches.size() < 3 || (static_cast<int>(batches.size()) < effort.batches && passed < effort.enough_seconds)) {
    const double seconds = seconds_of_batch(repetitions);
    passed += seconds;
    batches.push_back(seconds / static_cast<double>(repetitions));
  }
  return {.median = median(batches), .fastest = std::ranges::min(batches)};
}

double load_seconds(const Device& device, const Effort& effort) {
  return device.info().kind == DeviceKind::gpu ? effort.gpu_load_seconds : 0;
}

Timing seconds_each(Device& device, const Effort& effort, const std::function<void()>& queue) {
  const BatchTimer timer = [&](std::uint64_t repetitions) {
    device.mark_time();
    for (std::uint64_t k = 0; k < repetitions; ++k) queue();
    device.mark_time();
    const std::vector<double> times = device.take_times();
    return times[1] - times[0];
  };
  return seconds_each(effort, timer, load_seconds(device, effort));
}

}  // namespace pliant::bench
