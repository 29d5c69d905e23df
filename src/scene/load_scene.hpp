// Reads scene files, which are TOML, strictly. Every key and its range are in load_scene.cpp and body_tables.cpp, one line each.
// Defaults are in scene_description.hpp.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "scene/scene_description.hpp"

namespace pliant {

/// Reads a scene file and applies overrides, in order, before checking it. Loads no meshes and resolves no integrator.
/// An override is "section.key=value" or "body.NAME.key=value" in TOML's syntax. A bare word is a string.
/// Throws Error (input) that names "file:line: section.key" for the file, and Error (command_line) that names "--set ..." for an
/// override.
[[nodiscard]] SceneDescription load_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Does the same with a text that was read from `file`.
[[nodiscard]] SceneDescription parse_scene(const std::string& text, const std::filesystem::path& file,
                                           std::span<const std::string> overrides = {});

}  // namespace pliant
