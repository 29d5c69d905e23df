// The surfaces of a model's bodies on the GPU, for drawing.
#pragma once
#include <cstdint>

#include "gl/objects.hpp"
#include "gl/targets.hpp"
#include "mesh/incident_triangles.hpp"
#include "model/model.hpp"

namespace pliant::render {

/// Only `smooth`, the normals and strains, is computed again for each picture. Containers stand behind all other bodies.
struct DrawnSurface {
  /// Needs a current gl::Context while it lives. Throws Error (device) if there is no room for it.
  explicit DrawnSurface(const Model& model);

  std::uint32_t vertex_count, solid_vertex_count;  // of all, and without containers
  int index_count, solid_index_count;              // the same of triangles' corners
  gl::Buffer indices, rest, first_incident, incident, colors, smooth;
  gl::VertexArray vertices;

 private:
  DrawnSurface(const Model& model, const IncidentTriangles& around);
};

}  // namespace pliant::render
