// One dispatch of a schedule, recorded once and run many times.
#pragma once
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

#include "device/device.hpp"

namespace pliant {

struct Pass {
  std::string_view name;  // the kernel's
  KernelCall call;
  std::uint32_t item_count = 0;  // unless the device itself decides:
  BufferId group_counts = 0;     // where it has written how many groups to run
  std::size_t group_counts_byte = 0;
};

/// `buffers` and `parameters` by slot, from 0 on.
[[nodiscard]] inline Pass make_pass(Device& device, std::string_view name, std::initializer_list<BufferId> buffers,
                                    std::initializer_list<Parameter> parameters, std::uint32_t item_count) {
  Pass pass{.name = name, .call = {.kernel = device.kernel(name)}, .item_count = item_count};
  std::copy(buffers.begin(), buffers.end(), pass.call.buffers.begin());
  std::copy(parameters.begin(), parameters.end(), pass.call.parameters.begin());
  return pass;
}

/// A pass that runs as many groups as `group_counts` says at `byte`.
[[nodiscard]] inline Pass make_indirect_pass(Device& device, std::string_view name, std::initializer_list<BufferId> buffers,
                                             std::initializer_list<Parameter> parameters, BufferId group_counts,
                                             std::size_t byte) {
  Pass pass = make_pass(device, name, buffers, parameters, 0);
  pass.group_counts = group_counts;
  pass.group_counts_byte = byte;
  return pass;
}

inline void run_passes(Device& device, std::span<const Pass> passes) {
  for (const Pass& pass : passes) {
    if (pass.group_counts != 0)
      device.run_indirect(pass.call, pass.group_counts, pass.group_counts_byte);
    else
      device.run(pass.call, pass.item_count);
  }
}

}  // namespace pliant
