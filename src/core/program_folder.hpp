// Finds what stands beside the program.
#pragma once
#include <filesystem>
#include <system_error>

namespace pliant {

/// Returns the folder of this program's file, or an empty path if the system does not tell.
[[nodiscard]] inline std::filesystem::path program_folder() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
}

}  // namespace pliant
