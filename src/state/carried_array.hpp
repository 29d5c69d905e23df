// What one step leaves for the next, array by array: all of it together is what a run can go on from.
#pragma once
#include <cstddef>

#include "device/device.hpp"

namespace pliant {

/// A part of a device's array.
struct CarriedArray {
  BufferId buffer = 0;
  std::size_t first_byte = 0, byte_count = 0;
  bool is_real = false;  // numbers of the device's precision; others are the same on every device
};

template <class T>
[[nodiscard]] CarriedArray carried(const DeviceArray<T>& array) {
  return {.buffer = array.id(), .byte_count = array.size() * sizeof(T)};
}

}  // namespace pliant
