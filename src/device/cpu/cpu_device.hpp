// What is known of the CPU without opening it as a device: make_cpu_device in device/device.hpp does that.
#pragma once
#include <string>

namespace pliant::cpu {

/// The processor's name and its fastest instruction set, as in DeviceInfo.
[[nodiscard]] std::string device_name();

}  // namespace pliant::cpu
