// Makes meshes by formula from descriptions of the form "generator:argument".
#pragma once
#include <string>
#include <string_view>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Returns whether a mesh's description has the form "generator:argument" (known or not) instead of a file's path.
[[nodiscard]] bool is_generator(std::string_view description);

/// Returns what descriptions can look like: "icosphere:n, cube:n".
[[nodiscard]] std::string generator_forms();

/// Makes the mesh of a description. "icosphere:n", with n from 0 to 7, is a unit sphere of 10 * 4^n + 2 vertices. "cube:n", with
/// n from 1 to 100, is a cube of side 1 about the origin, with n * n cells a face and 6 n^2 + 2 vertices. Triangles wind
/// counter-clockwise seen from outside. Throws Error (input) for any other description, and says what exists.
[[nodiscard]] TriangleMesh generate_mesh(std::string_view description);

}  // namespace pliant
