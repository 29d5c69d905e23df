#include "render/drawn_surface.hpp"

#include <algorithm>

#include "model/inflation.hpp"

namespace pliant::render {
namespace {

/// Whether each edge of the body is in as many triangles forward as backward.
bool is_closed(const ModelBody& body, const IncidentTriangles& around) {
  std::vector<std::uint32_t> next, previous;
  for (std::uint32_t vertex = body.first_vertex; vertex < body.first_vertex + body.vertex_count; ++vertex) {
    next.clear(), previous.clear();
    for (std::uint32_t i = around.first[vertex]; i < around.first[vertex + 1]; ++i) {
      next.push_back(around.others[i][0]);
      previous.push_back(around.others[i][1]);
    }
    std::ranges::sort(next);
    std::ranges::sort(previous);
    if (next != previous) return false;
  }
  return true;
}

bool is_wound_outward(const Model& model, const ModelBody& body) {
  return volume_of(model, body, model.rest_positions_of(body)) > 0;
}

/// Containers are lit inside.
std::vector<glm::vec4> colors_of(const Model& model, const IncidentTriangles& around) {
  std::vector<glm::vec4> colors;
  for (const ModelBody& body : model.bodies) {
    const bool is_dark_inside = !body.is_container && is_closed(body, around) && is_wound_outward(model, body);
    colors.emplace_back(glm::vec3(body.color), is_dark_inside ? 1.0f : 0.0f);
  }
  return colors;
}

/// The bodies but for containers, which stand behind all others and cast no shadows.
struct Solids {
  explicit Solids(const Model& model)
      : vertex_count(model.vertex_count()), triangle_count(static_cast<std::uint32_t>(model.triangles.size())) {
    const auto container = std::ranges::find(model.bodies, true, &ModelBody::is_container);
    if (container == model.bodies.end()) return;
    vertex_count = container->first_vertex;
    triangle_count = container->first_triangle;
  }
  std::uint32_t vertex_count, triangle_count;
};

}  // namespace

DrawnSurface::DrawnSurface(const Model& model) : DrawnSurface(model, incident_triangles(model.vertex_count(), model.triangles)) {}

DrawnSurface::DrawnSurface(const Model& model, const IncidentTriangles& around)
    : vertex_count(model.vertex_count()),
      solid_vertex_count(Solids(model).vertex_count),
      index_count(static_cast<int>(model.triangles.size() * 3)),
      solid_index_count(static_cast<int>(Solids(model).triangle_count * 3)),
      indices(gl::buffer_of(model.triangles, "triangle corners")),
      rest(gl::buffer_of(model.rest_positions, "rest positions for drawing")),
      first_incident(gl::buffer_of(around.first, "first incident triangle")),
      incident(gl::buffer_of(around.others, "incident triangles")),
      colors(gl::buffer_of(colors_of(model, around), "body colours")),
      smooth(vertex_count * sizeof(glm::vec4), "smooth normals and strains"),
      vertices(indices) {}

}  // namespace pliant::render
