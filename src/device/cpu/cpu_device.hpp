// Says what is known of the CPU without opening it as a device. make_cpu_device in device/device.hpp opens it.
#pragma once
#include <string>

namespace pliant::cpu {

/// Returns the processor's name and its fastest instruction set, as in DeviceInfo.
[[nodiscard]] std::string device_name();

}  // namespace pliant::cpu
