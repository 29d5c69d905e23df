// Sums over the vertices in order, then over the list of forces.
#include "simulation/measure.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/forces/force.hpp"

namespace pliant {

Measurement measure(const Model& model, const State& state, const glm::dvec3& gravity, ThreadPool& pool,
                    const std::function<bool()>& stopped) {
  const std::vector<glm::dvec3> positions = state.world_positions(model);
  const std::vector<glm::dvec3> velocities = state.world_velocities(model);
  Measurement sum;
  for (std::uint32_t i = 0; i < model.vertex_count(); ++i) {
    if (model.body_of(i).is_static) continue;
    const double mass = model.body_of(i).vertex_mass;
    const glm::dvec3 momentum = mass * velocities[i];
    sum.kinetic += 0.5 * glm::dot(momentum, velocities[i]);
    sum.gravitational -= mass * glm::dot(gravity, positions[i]);
    sum.momentum += momentum;
    sum.angular_momentum += glm::cross(positions[i], momentum);
  }
  for (const Force& force : forces()) {
    if (!any_feels(model, force)) continue;
    const double energy = force.energy({model, state, pool, stopped});
    sum.elastic += energy;
    sum.elastic_size += std::abs(energy);
  }
  return sum;
}

}  // namespace pliant
