// What lies around the triangles of a mesh: their neighbours across edges, and which features belong to which triangle.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/trees/tree.hpp"
#include "model/model.hpp"
#include "physics/contact/surface.glsl"

namespace pliant {

/// Returns [triangle][4] of one body's triangles, as the array `triangle_around` has it. Vertices count from `first_vertex`.
/// - Of each edge, from corner k to the next, the third vertex of the triangle across it. An edge of three or more has none.
/// - As bits, the vertices and edges that belong to the triangle, because no triangle before has them.
[[nodiscard]] std::vector<std::uint32_t> surroundings(std::span<const std::array<std::uint32_t, 3>> triangles,
                                                      std::uint32_t first_vertex, std::uint32_t vertex_count);

/// Returns the surroundings of all bodies' triangles, and sets the surfaces' `to_mesh`. Bodies whose triangles have the same
/// surroundings share them, as those of one mesh do.
[[nodiscard]] std::vector<std::uint32_t> surroundings_of(const Model& model, const Forest& forest,
                                                         std::span<physics::Surface> surfaces);

}  // namespace pliant
