// Reads and writes the file around a checkpoint. The file names its version and shows when a byte of it is wrong or missing.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace pliant {

/// Raise it whenever the content of a checkpoint changes: fields, their order, or the device's structs.
inline constexpr std::uint32_t checkpoint_version = 41;

/// Throws Error (command_line) if no checkpoint can be written to `path`, or if anything but a checkpoint stands there, because
/// that would be lost.
void expect_place_for_checkpoint(const std::filesystem::path& path);

/// Replaces the file at `path` as a whole once the disk holds the new one. Throws Error (command_line) if it can't. The file is
/// then as it was.
void write_checkpoint(const std::filesystem::path& path, std::string_view content);

/// Returns the content. Throws Error (input) if the file is not a checkpoint, has another version, is cut short or is damaged.
[[nodiscard]] std::string read_checkpoint(const std::filesystem::path& path);

}  // namespace pliant
