// Removes vertices that no triangle uses.
#pragma once
#include <cstddef>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Keeps the order of the vertices that stay. Returns how many it removed.
std::size_t remove_unused_vertices(TriangleMesh& mesh);

}  // namespace pliant
