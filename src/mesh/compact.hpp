// Removes vertices that no triangle uses.
#pragma once
#include <cstddef>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Keeps the order of the vertices that stay; returns how many went.
std::size_t remove_unused_vertices(TriangleMesh& mesh);

}  // namespace pliant
