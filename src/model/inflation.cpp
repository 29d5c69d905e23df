#include "model/inflation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "mesh/report.hpp"
#include "model/body_error.hpp"
#include "physics/forces/pressure.glsl"

namespace pliant {
namespace {

void expect_encloses(const BodySetup& setup) {
  const MeshReport report = report_mesh(setup.mesh);
  if (!report.closed)
    throw body_error(
        setup.description,
        fmt::format("pressure needs a closed mesh, but {} edges have only one triangle", report.boundary_edge_count),
        fmt::format("close the mesh, {}or leave the pressure out",
                    setup.description.weld > 0 ? "" : "weld vertices that stand in one place (such as weld = 1e-6), "));
  if (report.inconsistent_edge_count > 0)
    throw body_error(setup.description,
                     fmt::format("pressure needs triangles that wind alike, but at {} edges not as many run forward as backward",
                                 report.inconsistent_edge_count),
                     "turn triangles that wind the other way, remove faces between parts of the mesh, or leave the pressure out");
  const ClosedParts parts = count_closed_parts(setup.mesh);
  if (parts.inward_count > 0)
    throw body_error(
        setup.description,
        fmt::format("pressure needs triangles that wind counter-clockwise seen from outside, but in {} of {} closed parts they "
                    "wind the other way",
                    parts.inward_count, parts.count),
        parts.inward_count == parts.count ? "turn all triangles, or leave the pressure out"
                                          : "turn all triangles of these parts, remove cavities, or leave the pressure out");
}

// Below this share of radius^3, fp32 rest positions do not tell the volume from zero. The bound on steps divides by the volume.
constexpr double least_rest_volume = 1e-6;

void expect_volume(const BodyDescription& description, const Inflation& inside, double radius) {
  if (!(inside.rest_volume > least_rest_volume * radius * radius * radius))
    throw body_error(description,
                     fmt::format("pressure needs a volume, but the mesh is flat: it encloses {:.3g} m^3 at a radius of {:.3g} m",
                                 inside.rest_volume, radius),
                     "use a thicker mesh, or leave the pressure out");
}

// What two triangles at an edge add to the volume's second derivative.
struct EdgeTerm {
  std::uint32_t low, high;  // the edge's vertices
  glm::dvec3 third;         // a triangle's third corner over 6, with the sign of the edge's direction
};

// Returns the terms of each edge one behind the other, in the order of triangles.
std::vector<EdgeTerm> edge_terms(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions) {
  std::vector<EdgeTerm> terms;
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = model.triangles[t][k], b = model.triangles[t][(k + 1) % 3], c = model.triangles[t][(k + 2) % 3];
      const auto [low, high] = std::minmax({a - body.first_vertex, b - body.first_vertex});
      terms.push_back({low, high, (a < b ? 1.0 : -1.0) * positions[c - body.first_vertex] / 6.0});
    }
  std::ranges::stable_sort(terms, {}, [](const EdgeTerm& term) { return std::pair(term.low, term.high); });
  return terms;
}

// Returns a bound on the norm of the volume's second derivative [m]. The derivative by two vertices a and b is the cross product
// with a vector of the edge ab. That vector is the sum of the edge's terms. The largest sum of these lengths over a vertex's
// edges is the bound (Gershgorin).
double curvature_of_volume(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions) {
  const std::vector<EdgeTerm> terms = edge_terms(model, body, positions);
  std::vector<double> sums(body.vertex_count, 0.0);
  for (std::size_t k = 0; k < terms.size();) {
    const auto [low, high, first] = terms[k];
    glm::dvec3 sum(0.0);
    for (; k < terms.size() && terms[k].low == low && terms[k].high == high; ++k) sum += terms[k].third;
    sums[low] += glm::length(sum);
    sums[high] += glm::length(sum);
  }
  return std::ranges::max(sums);
}

}  // namespace

double volume_of(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions) {
  double volume = 0;
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const auto corner = [&](int k) { return positions[model.triangles[t][k] - body.first_vertex]; };
    volume += physics::volume_below(corner(0), corner(1), corner(2));
  }
  return volume;
}

VolumeAt volume_at(const Model& model, const ModelBody& body, std::span<const glm::dvec3> positions) {
  VolumeAt at{.volume = volume_of(model, body, positions)};
  std::vector<glm::dvec3> gradients(body.vertex_count, glm::dvec3(0.0));
  for (std::uint32_t t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t corner = model.triangles[t][k] - body.first_vertex;
      const glm::dvec3 a = positions[corner], b = positions[model.triangles[t][(k + 1) % 3] - body.first_vertex],
                       c = positions[model.triangles[t][(k + 2) % 3] - body.first_vertex];
      gradients[corner] += physics::volume_gradient(a, b, c);
    }
  for (const glm::dvec3& gradient : gradients) at.gradient_squared += glm::dot(gradient, gradient);
  at.curvature = curvature_of_volume(model, body, positions);
  return at;
}

Inflation inflate(const BodySetup& setup, const Model& model, const ModelBody& body) {
  expect_encloses(setup);
  const VolumeAt rest = volume_at(model, body, model.rest_positions_of(body));
  const Inflation inside{.pressure = setup.description.pressure,
                         .law = setup.description.pressure_law,
                         .rest_volume = rest.volume,
                         .gradient_squared = rest.gradient_squared,
                         .curvature = rest.curvature};
  expect_volume(setup.description, inside, body.radius);
  return inside;
}

}  // namespace pliant
