// Checksums tell whether bytes are the same: 64-bit FNV-1a, by Fowler, Noll and Vo (draft-eastlake-fnv). Each byte permutes the
// possible checksums, so a single wrong byte always shows. It does not protect against deliberate changes.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace pliant {

inline constexpr std::uint64_t checksum_of_nothing = 0xcbf29ce484222325u;

/// Returns the checksum of some bytes and of those before them, whose checksum is `before`.
[[nodiscard]] inline std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t before = checksum_of_nothing) {
  for (const std::byte byte : bytes) before = (before ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
  return before;
}

[[nodiscard]] inline std::uint64_t checksum(std::string_view bytes) { return checksum(std::as_bytes(std::span(bytes))); }

}  // namespace pliant
