// What a file's name says that it holds.
#pragma once
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace pliant {

/// In lower case: ".obj" of "Bunny.OBJ".
[[nodiscard]] inline std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace pliant
