// Tells from a file's name what the file holds.
#pragma once
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace pliant {

/// Returns the extension in lower case: ".obj" for "Bunny.OBJ".
[[nodiscard]] inline std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace pliant
