#include "model/inflation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "mesh/report.hpp"
#include "model/body_error.hpp"
#include "physics/forces/pressure.glsl"

namespace pliant {
namespace {

void expect_encloses(const BodySetup& setup) {
  const MeshReport report = report_mesh(setup.mesh);
  if (!report.closed)
    throw body_error(setup.description,
                     fmt::format("pressure needs a closed mesh, but {} edges have only one triangle", report.boundary_edge_count),
                     "close the mesh, weld vertices that stand in one place (such as weld = 1e-6), or leave the pressure out");
  if (!report.volume)
    throw body_error(
        setup.description,
        fmt::format("pressure needs triangles that wind alike, but at {} edges two do not", report.inconsistent_edge_count),
        "turn these triangles, or leave the pressure out");
  if (!(*report.volume > 0))
    throw body_error(setup.description,
                     "pressure needs triangles that wind counter-clockwise seen from outside, but these wind the other way",
                     "turn all triangles, or leave the pressure out");
}

// Returns a bound on the norm of the volume's second derivative [m]. The derivative by two vertices a and b is the cross product
// with a vector of the edge ab. That vector is the sum of the edge's triangles' third corners over 6, with the sign of the edge's
// direction. The largest sum of these lengths over a vertex's edges is the bound (Gershgorin).
double curvature_of_volume(const Model& model, const ModelBody& body) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, glm::dvec3> third_corners;
  for (std::size_t t = body.first_triangle; t < model.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = model.triangles[t][k], b = model.triangles[t][(k + 1) % 3], c = model.triangles[t][(k + 2) % 3];
      third_corners[std::minmax(a, b)] += (a < b ? 1.0 : -1.0) * model.rest_position(c) / 6.0;
    }
  std::map<std::uint32_t, double> sums;
  for (const auto& [edge, sum] : third_corners)
    for (const std::uint32_t end : {edge.first, edge.second}) sums[end] += glm::length(sum);
  double largest = 0;
  for (const auto& [vertex, sum] : sums) largest = std::max(largest, sum);
  return largest;
}

}  // namespace

Inflation inflate(const BodySetup& setup, const Model& model, const ModelBody& body) {
  expect_encloses(setup);
  Inflation inside{.pressure = setup.description.pressure, .law = setup.description.pressure_law};
  std::vector<glm::dvec3> gradients(body.vertex_count, glm::dvec3(0.0));
  for (std::size_t t = body.first_triangle; t < model.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t corner = model.triangles[t][k];
      const glm::dvec3 a = model.rest_position(corner), b = model.rest_position(model.triangles[t][(k + 1) % 3]),
                       c = model.rest_position(model.triangles[t][(k + 2) % 3]);
      gradients[corner - body.first_vertex] += physics::volume_gradient(a, b, c);
      if (k == 0) inside.rest_volume += physics::volume_below(a, b, c);
    }
  for (const glm::dvec3& gradient : gradients) inside.gradient_squared += glm::dot(gradient, gradient);
  inside.curvature = curvature_of_volume(model, body);
  return inside;
}

}  // namespace pliant
