// Reads a whole input file.
#pragma once
#include <filesystem>
#include <string>

namespace pliant {

/// Throws Error (input) naming the path when it is missing, a folder or unreadable.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

}  // namespace pliant
