// Recording passes, and timing them.
#pragma once
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <string_view>

#include "device/device.hpp"

namespace pliant {

/// `buffers` and `parameters` by slot, from 0 on.
[[nodiscard]] inline Pass make_pass(std::string_view name, KernelId kernel, std::initializer_list<BufferId> buffers,
                                    std::initializer_list<Parameter> parameters, std::uint32_t item_count) {
  Pass pass{.name = name, .call = {.kernel = kernel}, .item_count = item_count};
  std::copy(buffers.begin(), buffers.end(), pass.call.buffers.begin());
  std::copy(parameters.begin(), parameters.end(), pass.call.parameters.begin());
  return pass;
}

[[nodiscard]] inline Pass make_pass(Device& device, std::string_view name, std::initializer_list<BufferId> buffers,
                                    std::initializer_list<Parameter> parameters, std::uint32_t item_count) {
  return make_pass(name, device.kernel(name), buffers, parameters, item_count);
}

[[nodiscard]] inline Pass beside_next(Pass pass) {
  pass.beside_next = true;
  return pass;
}

/// Runs passes one by one, none beside another, and adds to `seconds` what each took. Costs more than Device::run, as the device
/// has to look at its clock in between.
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
