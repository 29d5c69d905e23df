// Carried arrays as bytes, and back.
#pragma once
#include <span>
#include <string_view>

#include "core/bytes.hpp"
#include "state/arrays.hpp"

namespace pliant {

/// Waits for the device.
void write_arrays(Device& device, std::span<const CarriedArray> arrays, ByteWriter& to);

/// What write_arrays wrote, of arrays alike. From another precision, numbers of the forces' are rounded to this one's. Throws
/// Error (input) where an array has another length; what came before it is read by then.
void read_arrays(Device& device, std::span<const CarriedArray> arrays, ByteReader& from);

}  // namespace pliant
