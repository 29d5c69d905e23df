#include "window/saved_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "output/file.hpp"
#include "output/png.hpp"
#include "scene/scene_text.hpp"

namespace pliant::view {
namespace {

std::filesystem::path free_name(const std::string& stem, const char* extension) {
  for (int number = 0;; ++number) {
    std::filesystem::path name = fmt::format("{}_{:04}{}", stem, number, extension);
    if (!std::filesystem::exists(name)) return name;
  }
}

}  // namespace

std::vector<std::filesystem::path> scenes_beside(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> scenes;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  for (const auto& entry :
       std::filesystem::directory_iterator(folder, std::filesystem::directory_options::skip_permission_denied))
    if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
  std::ranges::sort(scenes);
  return scenes;
}

std::filesystem::path save_picture(const std::string& stem, const render::Image& picture) {
  std::filesystem::path name = free_name(stem, ".png");
  write_png(name, picture);
  return name;
}

std::filesystem::path save_scene(const SceneDescription& scene) {
  std::filesystem::path name = free_name(scene.file.stem().string(), ".toml");
  WholeFile file(name);
  file.write(scene_text(scene, name.parent_path()));
  file.close();
  return name;
}

}  // namespace pliant::view
