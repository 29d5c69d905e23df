// Reads a whole input file.
#pragma once
#include <filesystem>
#include <string>

namespace pliant {

/// Returns the file's content. Throws Error (input) that names the path if it is missing, unreadable or not a plain file.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

}  // namespace pliant
