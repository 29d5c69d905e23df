// The demos of the start page: scenes that are made to be played with.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace pliant::view {

struct Demo {
  std::filesystem::path scene;
  std::string title;
  std::string about;  // what it shows and what to try
};

/// Returns the folder of demos: `scenes/demos` in the current folder, or else beside where the program was built or installed.
/// Throws Error (input) if there is none.
[[nodiscard]] std::filesystem::path demo_folder();

/// Returns the demos in a folder, by the names of their files. A scene that can't be loaded is left out, with a warning on
/// standard error. Throws Error (input) if none is left.
[[nodiscard]] std::vector<Demo> find_demos(const std::filesystem::path& folder);

}  // namespace pliant::view
