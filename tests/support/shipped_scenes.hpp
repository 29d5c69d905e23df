// The scenes in scenes/.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/load_scene.hpp"
#include "support/paths.hpp"

namespace pliant::test {

inline SceneDescription load_shipped_scene(const std::string& name, std::span<const std::string> overrides = {}) {
  return load_scene(source_dir() + "/scenes/" + name + ".toml", overrides);
}

inline std::vector<SceneDescription> load_shipped_scenes() {
  std::vector<SceneDescription> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/scenes"))
    if (entry.path().extension() == ".toml") scenes.push_back(load_scene(entry.path()));
  return scenes;
}

/// Brute force, and a GPU in software, take minutes where there are many more bodies.
constexpr std::size_t most_bodies = 128;

/// Of a scene with more than most_bodies it keeps that many, evenly spread over their list. This is the one rule for tests of
/// every scene that would take too long with all bodies. What is apart stays apart.
inline SceneDescription thinned(SceneDescription scene) {
  const std::size_t count = scene.bodies.size();
  if (count <= most_bodies) return scene;
  std::vector<BodyDescription> kept;
  for (std::size_t k = 0; k < most_bodies; ++k) kept.push_back(scene.bodies[k * count / most_bodies]);
  scene.bodies = std::move(kept);
  return scene;
}

inline std::vector<SceneDescription> load_thinned_scenes() {
  std::vector<SceneDescription> scenes = load_shipped_scenes();
  for (SceneDescription& scene : scenes) scene = thinned(std::move(scene));
  return scenes;
}

/// Those whose bodies meet by `reflect`. The others have the same bodies, or gravity, grounds and static bodies.
inline std::vector<SceneDescription> load_reflecting_scenes() {
  std::vector<SceneDescription> scenes = load_shipped_scenes();
  std::erase_if(scenes, [](const SceneDescription& scene) { return scene.collision.response.value != "reflect"; });
  return scenes;
}

}  // namespace pliant::test
