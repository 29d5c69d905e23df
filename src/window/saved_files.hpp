// Files that the viewer lists and saves. Names of saved ones have the first free number: "bunny_0000.png".
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "render/image.hpp"
#include "scene/scene_description.hpp"

namespace pliant::view {

/// Returns the scenes in the folder of `file`, sorted by name.
[[nodiscard]] std::vector<std::filesystem::path> scenes_beside(const std::filesystem::path& file);

/// Writes a PNG to the current folder, and returns its name. Throws Error (command_line) if it can't be written.
std::filesystem::path save_picture(const std::string& stem, const render::Image& picture);

/// Writes a scene to the current folder, named as its file, and returns its name. Throws Error (command_line) if it can't be
/// written.
std::filesystem::path save_scene(const SceneDescription& scene);

}  // namespace pliant::view
