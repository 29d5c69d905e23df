#include "view/demos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <system_error>

#include "core/error.hpp"
#include "core/program_folder.hpp"
#include "scene/load_scene.hpp"

namespace pliant::view {
namespace {

constexpr const char* remedy = "name a scene, as in pliant view SCENE, or run pliant where scenes/demos is";

}  // namespace

std::filesystem::path demo_folder() {
  const std::filesystem::path program = program_folder(), built_from = program.parent_path().parent_path();
  for (const std::filesystem::path& folder :
       {std::filesystem::path("scenes/demos"), built_from / "scenes/demos", program.parent_path() / "share/pliant/scenes/demos"})
    if (std::error_code none; std::filesystem::is_directory(folder, none)) return folder;
  throw Error(ErrorKind::input, "", "there is no folder of demos", remedy);
}

std::vector<Demo> find_demos(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<Demo> demos;
  for (const std::filesystem::path& file : files) try {
      const SceneDescription scene = load_scene(file);
      demos.push_back({file, scene.title.empty() ? file.stem().string() : scene.title, scene.about});
    } catch (const Error& error) {
      fmt::print(stderr, "pliant: warning: {}\n", error.what());
    }
  if (demos.empty()) throw Error(ErrorKind::input, folder.string(), "has no demos", remedy);
  return demos;
}

}  // namespace pliant::view
