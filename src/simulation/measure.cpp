// Sums over the vertices in order, then over the list of forces.
#include "simulation/measure.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/forces/force.hpp"

namespace pliant {

namespace {

template <class T>
T sum_in_order(const std::vector<T>& terms) {
  T sum(0.0);
  for (const T& term : terms) sum += term;
  return sum;
}

}  // namespace

Meter::Meter(const Model& model)
    : model_(model),
      terms_{.kinetic = std::vector<double>(model.vertex_count()),
             .gravitational = std::vector<double>(model.vertex_count()),
             .momentum = std::vector<glm::dvec3>(model.vertex_count()),
             .angular_momentum = std::vector<glm::dvec3>(model.vertex_count())} {}

void Meter::set_terms(const State& state, const glm::dvec3& gravity, ThreadPool& pool) {
  pool.for_ranges(model_.vertex_count(), 1024, [&](std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t i = first; i < end; ++i) {
      if (model_.body_of(i).is_rigid()) continue;
      const double mass = model_.body_of(i).vertex_mass;
      const glm::dvec3 position = state.world_position(model_, i), velocity = state.world_velocity(model_, i);
      const glm::dvec3 momentum = mass * velocity;
      terms_.kinetic[i] = 0.5 * glm::dot(momentum, velocity);
      terms_.gravitational[i] = -mass * glm::dot(gravity, position);
      terms_.momentum[i] = momentum;
      terms_.angular_momentum[i] = glm::cross(position, momentum);
    }
  });
}

Measurement Meter::measure(const State& state, const glm::dvec3& gravity, ThreadPool& pool,
                           const std::function<bool()>& stopped) {
  set_terms(state, gravity, pool);
  Measurement sum;
  const std::function<void()> sums[] = {[&] { sum.kinetic = sum_in_order(terms_.kinetic); },
                                        [&] { sum.gravitational = sum_in_order(terms_.gravitational); },
                                        [&] { sum.momentum = sum_in_order(terms_.momentum); },
                                        [&] { sum.angular_momentum = sum_in_order(terms_.angular_momentum); }};
  pool.for_ranges(std::size(sums), 1, [&](std::uint32_t k, std::uint32_t) { sums[k](); });
  kept_.resize(forces().size());
  for (std::size_t k = 0; k < forces().size(); ++k) {
    const Force& force = forces()[k];
    if (!any_feels(model_, force)) continue;
    const double energy = force.energy({model_, state, pool, stopped, kept_[k]});
    sum.elastic += energy;
    sum.elastic_size += std::abs(energy);
  }
  return sum;
}

Measurement measure(const Model& model, const State& state, const glm::dvec3& gravity, ThreadPool& pool,
                    const std::function<bool()>& stopped) {
  return Meter(model).measure(state, gravity, pool, stopped);
}

}  // namespace pliant
