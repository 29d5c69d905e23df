// Makes meshes by formula from descriptions of the form "generator:argument".
#pragma once
#include <string>
#include <string_view>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Returns whether a mesh's description has the form "generator:argument" (known or not) instead of a file's path.
[[nodiscard]] bool is_generator(std::string_view description);

/// Returns what descriptions can look like: "icosphere:n, cube:n, ...".
[[nodiscard]] std::string generator_forms();

/// Makes the mesh of a description. Throws Error (input) for any other description, and says what exists.
///
/// | description | mesh |
/// |---|---|
/// | icosphere:n | a unit sphere of 10 * 4^n + 2 vertices, n from 0 to 9 |
/// | cube:n | a cube of side 1 about the origin, with n * n cells a face and 6 n^2 + 2 vertices, n from 1 to 100 |
/// | box:x,y,z,n | a box of these sizes about the origin, with n nearly square cells along its longest side |
/// | crate:x,y,z,n | the same without its top |
/// | bowl:n | the lower half of a unit sphere's surface, with 2 n by 2 n cells at its bottom and n up its sides |
/// | ring:r,n | a torus about the y axis, of radius 1 to the middle of a tube of radius r, with n cells around |
///
/// Triangles wind counter-clockwise seen from outside.
[[nodiscard]] TriangleMesh generate_mesh(std::string_view description);

}  // namespace pliant
