// Scene files: TOML, read strictly. Every key, its range and its default are in load_scene.cpp, one line each.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "scene/scene_description.hpp"

namespace pliant {

/// Reads a scene file and applies overrides, in order, before checking it. An override is "section.key=value" or
/// "body.NAME.key=value" in TOML's syntax; a bare word is a string. Loads no meshes and resolves no integrator.
/// Throws Error: input, naming "file:line: section.key", for the file; command_line, naming "--set ...", for an override.
[[nodiscard]] SceneDescription load_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same of a text that was read from `file`.
[[nodiscard]] SceneDescription parse_scene(const std::string& text, const std::filesystem::path& file,
                                           std::span<const std::string> overrides = {});

}  // namespace pliant
