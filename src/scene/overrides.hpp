// Overrides of a scene's values, as `--set` gives them.
#pragma once
#include <string>

#include "scene/toml.hpp"

namespace pliant {

/// Replaces or adds a value below `root`. The text is section.key=value or body.NAME.key=value. The value is TOML, or a bare
/// word. Throws Error (command_line) that repeats the text.
void apply_override(toml::table& root, const std::string& text);

}  // namespace pliant
