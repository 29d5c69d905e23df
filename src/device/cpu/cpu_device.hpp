// Says what is known of the CPU without opening it as a device. make_cpu_device in device/device.hpp opens it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace pliant::cpu {

/// Returns the processor's name and its fastest instruction set, as in DeviceInfo.
[[nodiscard]] std::string device_name();

/// Returns the scratch memory in which the device sums springs, where bodies that move have so many vertices each [bytes].
[[nodiscard]] std::size_t spring_scratch_bytes(std::span<const std::uint32_t> vertex_counts, int precision);

}  // namespace pliant::cpu
