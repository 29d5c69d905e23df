// The scenes in scenes/.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scene/load_scene.hpp"
#include "support/paths.hpp"

namespace pliant::test {

inline SceneDescription load_shipped_scene(const std::string& name) {
  return load_scene(source_dir() + "/scenes/" + name + ".toml");
}

inline std::vector<SceneDescription> load_shipped_scenes() {
  std::vector<SceneDescription> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/scenes"))
    if (entry.path().extension() == ".toml") scenes.push_back(load_scene(entry.path()));
  return scenes;
}

/// Those whose bodies meet by `reflect`. The others have the same bodies, or gravity, grounds and static bodies.
inline std::vector<SceneDescription> load_reflecting_scenes() {
  std::vector<SceneDescription> scenes = load_shipped_scenes();
  std::erase_if(scenes, [](const SceneDescription& scene) { return scene.collision.response.value != "reflect"; });
  return scenes;
}

}  // namespace pliant::test
