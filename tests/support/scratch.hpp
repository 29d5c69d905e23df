// A folder for the files of one test.
#pragma once
#include <filesystem>
#include <random>
#include <string>
#include <system_error>

namespace pliant::test {

/// A fresh folder, removed at the end.
struct ScratchFolder {
  std::filesystem::path path;
  ScratchFolder() {
    std::random_device random;
    do path = std::filesystem::temp_directory_path() / ("pliant_test_" + std::to_string(random()));
    while (!std::filesystem::create_directory(path));
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
};

}  // namespace pliant::test
