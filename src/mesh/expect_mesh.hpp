// Checks meshes that did not come from a file.
#pragma once
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Throws Error (input), without a place, if a mesh has no vertices, if a position is not finite or beyond max_coordinate
/// (obj.hpp), or if a triangle names a vertex twice, or one that the mesh does not have.
void expect_mesh(const TriangleMesh& mesh);

}  // namespace pliant
