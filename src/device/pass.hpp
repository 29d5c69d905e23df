// Lets passes run beside each other, and times them.
#pragma once
#include <map>
#include <span>
#include <string_view>

#include "device/device.hpp"

namespace pliant {

[[nodiscard]] inline Pass beside_next(Pass pass) {
  pass.beside_next = true;
  return pass;
}

/// Lets all of these run beside each other.
inline void run_together(std::span<Pass> passes) {
  for (std::size_t k = 0; k + 1 < passes.size(); ++k) passes[k].beside_next = true;
}

/// Runs passes one by one, none beside another, and adds to `seconds` what each took. Costs more than Device::run, because the
/// device has to read its clock in between.
inline void run_timed(Device& device, std::span<const Pass> passes, std::map<std::string_view, double>& seconds) {
  device.mark_time();
  for (Pass pass : passes) {
    pass.beside_next = false;
    device.run({&pass, 1});
    device.mark_time();
  }
  const std::vector<double> times = device.take_times();
  for (std::size_t k = 0; k < passes.size(); ++k) seconds[passes[k].name] += times[k + 1] - times[k];
}

}  // namespace pliant
