#include "bench/common/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

#include "model/deform.hpp"

namespace pliant::bench {

TriangleMesh spiral_sphere(std::uint32_t vertex_count) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < vertex_count; ++i) {
    const double z = 1 - (2.0 * i + 1) / vertex_count, angle = 2 * std::numbers::pi * (2 - std::numbers::phi) * i;
    const double radius = std::sqrt(1 - z * z);
    mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return mesh;
}

ModelAndState deformed_body(TriangleMesh mesh) {
  BodySetup setup;
  setup.mesh = std::move(mesh);
  setup.description.name = "body";
  ModelAndState built = build_model({&setup, 1}, glm::dvec3(0.0));
  const double amplitude = 0.03 * built.model.bodies.front().radius;
  displace(built.state, [&](std::size_t i) { return amplitude * glm::sin(glm::dvec3(7 * i, 11 * i + 1, 15 * i + 2)); });
  return built;
}

}  // namespace pliant::bench
