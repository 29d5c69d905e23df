#include "bench/forces/peak_rate.hpp"

#include "device/cpu/peak.hpp"
#include "device/gpu/peak.hpp"

namespace pliant::bench {

double multiply_adds_per_second(Device& device, const Place& place, std::optional<cpu::Isa> isa, const Effort& effort) {
  if (place.device == DeviceKind::gpu) {
    gpu::Peak peak(device);
    return static_cast<double>(peak.multiply_adds()) / seconds_each(device, effort, [&] { peak.run(); }).fastest;
  }
  ThreadPool pool(place.threads);
  std::uint64_t count = 0;
  const Timing each = seconds_each(
      device, effort, [&] { count = cpu::run_multiply_adds(pool, isa.value_or(cpu::Isa::portable), place.precision); });
  return static_cast<double>(count) / each.fastest;
}

}  // namespace pliant::bench
