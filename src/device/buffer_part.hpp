// Some bytes of a device's buffer, or all of them.
#pragma once
#include <cstddef>

#include "core/expect.hpp"
#include "device/device.hpp"

namespace pliant {

/// Ends the program if an access leaves the part: what lies beside it belongs to others.
struct BufferPart {
  BufferId whole = 0;
  std::size_t first_byte = 0, size = 0;  // in the whole buffer

  /// Returns where bytes of the part begin in the whole buffer.
  [[nodiscard]] std::size_t place_of(std::size_t first, std::size_t bytes) const {
    PLIANT_EXPECT(first <= size && bytes <= size - first);
    return first_byte + first;
  }
  /// Returns these bytes.
  [[nodiscard]] BufferPart part(std::size_t first, std::size_t bytes) const { return {whole, place_of(first, bytes), bytes}; }
};

}  // namespace pliant
