// Writes carried arrays as bytes, and reads them back.
#pragma once
#include <span>
#include <string_view>

#include "core/bytes.hpp"
#include "state/arrays.hpp"

namespace pliant {

/// Waits for the device.
void write_arrays(Device& device, std::span<const CarriedArray> arrays, ByteWriter& to);

/// Reads what write_arrays wrote for the same arrays. If the precision was another one, numbers of that precision are rounded to
/// this device's. Throws Error (input) if an array has another name or length. The arrays before it have been read by then.
void read_arrays(Device& device, std::span<const CarriedArray> arrays, ByteReader& from);

}  // namespace pliant
