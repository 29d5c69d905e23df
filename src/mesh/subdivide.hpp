// Splits each triangle of a mesh in four, as often as asked.
#pragma once
#include <cstdint>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

enum class Subdivision {
  midpoint,  // vertices stay, and those between them stand in the middles of edges. So the surface stays as it is
  loop,      // vertices are placed and moved by Loop's masks, so that the surface becomes smooth
};

/// Most vertices and triangles that a mesh may have after subdivision. Arrays of six numbers a vertex, and of three a triangle,
/// are counted in 32 bits.
inline constexpr std::uint64_t most_mesh_vertices = 0xffffffff / 6, most_mesh_triangles = 0xffffffff / 3 - 1;

/// Most subdivisions of any mesh. One more would make too many triangles of a single one.
inline constexpr unsigned most_subdivisions = 15;

/// Subdivides a mesh `count` times. Throws Error (input), without a place, before it makes too many vertices or triangles, or
/// more than there is memory for.
///
/// A subdivision keeps the vertices' numbers. Behind them it adds one vertex for each edge, in the order in which triangles first
/// name them. Triangle t becomes 4 t to 4 t + 3: those at its corners in their order, then the one in its middle, and all wind as
/// it did. Triangles share the new vertices, so a closed mesh stays closed.
///
/// With `loop`:
/// - Masks of closed surfaces are those of C. Loop, "Smooth subdivision surfaces based on triangles", Master's thesis, University
///   of Utah 1987. Those of boundaries and creases are of H. Hoppe et al., "Piecewise smooth surface reconstruction", SIGGRAPH
///   1994.
/// - Edges with one triangle, or with three or more, are creases. They become cubic B-splines, whatever stands beside them.
/// - A vertex with one crease edge, or with three or more, stays where it is.
[[nodiscard]] TriangleMesh subdivide(const TriangleMesh& mesh, unsigned count, Subdivision scheme = Subdivision::midpoint);

}  // namespace pliant
