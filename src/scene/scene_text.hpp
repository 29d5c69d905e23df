// Writes scene files, which load_scene.hpp reads.
#pragma once
#include <filesystem>
#include <string>

#include "scene/scene_description.hpp"

namespace pliant {

/// Returns the text of a scene file in `folder` that parse_scene reads as the same description. Defaults are left out, and each
/// body has a table of its own. It checks no ranges: only what a scene file may say can be read again.
[[nodiscard]] std::string scene_text(const SceneDescription& scene, const std::filesystem::path& folder);

}  // namespace pliant
