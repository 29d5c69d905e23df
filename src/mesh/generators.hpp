// Meshes made by formula, written "generator:argument".
#pragma once
#include <string>
#include <string_view>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Whether a mesh's description has the form "generator:argument" (known or not) instead of a file's path.
[[nodiscard]] bool is_generator(std::string_view description);

/// What descriptions can look like: "icosphere:n".
[[nodiscard]] std::string generator_forms();

/// "icosphere:n", n from 0 to 7: a unit sphere of 10 * 4^n + 2 vertices. Corners run counter-clockwise seen from outside.
/// Throws Error (input) that lists what exists.
[[nodiscard]] TriangleMesh generate_mesh(std::string_view description);

}  // namespace pliant
