// The file around a checkpoint: says what it is and of which version, and shows when a byte of it is wrong or missing.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace pliant {

/// To be raised whenever what a checkpoint holds changes: fields, their order, or the device's structs.
inline constexpr std::uint32_t checkpoint_version = 7;

/// Throws Error (command_line) where one may not write a checkpoint: also where anything stands that is none, for it would be
/// lost.
void expect_place_for_checkpoint(const std::filesystem::path& path);

/// Replaces `path` as a whole once the disk holds the new one. Throws Error (command_line) where it can't; `path` is then as it
/// was.
void write_checkpoint(const std::filesystem::path& path, std::string_view content);

/// The content. Throws Error (input) when the file is none of pliant's, of another version, cut short or damaged.
[[nodiscard]] std::string read_checkpoint(const std::filesystem::path& path);

}  // namespace pliant
