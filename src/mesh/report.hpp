// Reports what a mesh consists of and what is wrong with it.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "mesh/triangle_mesh.hpp"

namespace pliant {

struct MeshReport {
  std::size_t vertex_count = 0, triangle_count = 0, edge_count = 0;
  std::size_t component_count = 0;            // parts that share no vertex
  std::size_t boundary_edge_count = 0;        // in one triangle
  std::size_t non_manifold_edge_count = 0;    // in three triangles or more
  std::size_t non_manifold_vertex_count = 0;  // whose triangles form more than one fan
  std::size_t inconsistent_edge_count = 0;    // in two triangles or more, not as many forward as backward
  std::size_t duplicate_position_count = 0;   // vertices exactly where an earlier one stands
  std::size_t zero_area_triangle_count = 0;
  bool closed = false;                   // every edge is in two triangles or more
  bool manifold = false;                 // no non-manifold edge or vertex
  long euler_characteristic = 0;         // vertices - edges + triangles
  std::optional<long> genus;             // handles of all components, if closed, manifold and wound consistently
  glm::dvec3 lowest{0.0}, highest{0.0};  // corners of the bounding box [mesh units]
  double area = 0;                       // [mesh units^2]
  std::optional<double> volume;          // enclosed [mesh units^3], positive if wound outward, if closed and wound consistently
};

[[nodiscard]] MeshReport report_mesh(const TriangleMesh& mesh);

/// Counts triangles whose area is below 1e-12 of their longest edge squared.
[[nodiscard]] std::size_t count_zero_area_triangles(const TriangleMesh& mesh);

/// Parts of a closed mesh that hang together by edges.
struct ClosedParts {
  std::size_t count = 0;
  std::size_t inward_count = 0;  // whose triangles wind inward, so that their volume is negative
};

/// Counts the parts of a closed mesh that is wound consistently.
[[nodiscard]] ClosedParts count_closed_parts(const TriangleMesh& mesh);

/// Return a few aligned lines for people, and a JSON object for programs. Both end in a newline.
[[nodiscard]] std::string to_text(const MeshReport& report);
[[nodiscard]] std::string to_json(const MeshReport& report);

}  // namespace pliant
