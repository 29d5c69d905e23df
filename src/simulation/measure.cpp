// Sums per vertex, then over vertices in order.
#define REAL_BITS 64
#include "simulation/measure.hpp"

#include "physics/forces/spring.glsl"

namespace pliant {
namespace {

glm::dvec3 displacement_of(const State& state, std::uint32_t vertex) {
  const double* u = &state.motion[std::size_t{6} * vertex];
  return {u[0], u[1], u[2]};
}

// The energy of the springs from `i` to later vertices of its body.
double elastic_energy(const Model& model, const State& state, std::uint32_t i) {
  const ModelBody& body = model.body_of(i);
  const double unit = body.unit_of_length();
  const glm::dvec3 rest(model.rest_positions[i]);
  const glm::dvec3 moved = displacement_of(state, i);
  double sum = 0;
  for (std::uint32_t j = i + 1; j < body.first_vertex + body.vertex_count; ++j) {
    const glm::dvec3 d = (moved - displacement_of(state, j)) / unit;
    const glm::dvec3 x = (rest - glm::dvec3(model.rest_positions[j])) / unit + d;
    const glm::dvec3 elongation = physics64::spring_strain(x, d) * x;
    sum += glm::dot(elongation, elongation);
  }
  return 0.5 * body.stiffness * unit * unit * sum;
}

}  // namespace

Measurement measure(const Model& model, const State& state, const glm::dvec3& gravity, ThreadPool& pool) {
  std::vector<double> elastic(model.vertex_count());
  pool.for_ranges(model.vertex_count(), 16, [&](std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t i = first; i < end; ++i) elastic[i] = elastic_energy(model, state, i);
  });
  const std::vector<glm::dvec3> positions = state.world_positions(model);
  const std::vector<glm::dvec3> velocities = state.world_velocities(model);
  Measurement sum;
  for (std::uint32_t i = 0; i < model.vertex_count(); ++i) {
    const double mass = model.body_of(i).vertex_mass;
    const glm::dvec3 momentum = mass * velocities[i];
    sum.elastic += elastic[i];
    sum.kinetic += 0.5 * glm::dot(momentum, velocities[i]);
    sum.gravitational -= mass * glm::dot(gravity, positions[i]);
    sum.momentum += momentum;
    sum.angular_momentum += glm::cross(positions[i], momentum);
  }
  return sum;
}

}  // namespace pliant
