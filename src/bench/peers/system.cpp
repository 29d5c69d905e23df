#include "bench/peers/system.hpp"

#include <glm/geometric.hpp>

#include "core/expect.hpp"
#include "physics/damping.glsl"

namespace pliant::bench {

PeerSystem::PeerSystem(const Model& model, DampingLaw law, double omega)
    : model_(model),
      law_(law),
      omega_(omega),
      vertex_count_(model.vertex_count()),
      springs_(cpu::available_isas().back()),
      positions_(vertex_count_),
      displacements_(vertex_count_),
      sums_(vertex_count_) {
  PLIANT_EXPECT(model.bodies.size() == 1 && model.bodies.front().inflation.pressure == 0);
  PLIANT_EXPECT(law != DampingLaw::internal);
  for (const glm::vec4& rest : model.rest_positions)
    rest_.emplace_back(glm::dvec3(rest) / model.bodies.front().unit_of_length(), 0.0);
}

std::vector<double> PeerSystem::numbers_of(const State& state) const {
  std::vector<double> numbers(size());
  for (std::size_t i = 0; i < vertex_count_; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      numbers[3 * i + k] = state.displacement(i)[static_cast<int>(k)];
      numbers[3 * (vertex_count_ + i) + k] = state.velocity(i)[static_cast<int>(k)] / omega_;
    }
  return numbers;
}

State PeerSystem::state_of(const std::vector<double>& numbers, const State& start) const {
  State state = start;
  for (std::size_t i = 0; i < vertex_count_; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto vertex = static_cast<std::uint32_t>(i);
      state.motion[physics::displacement_of(vertex) + k] = numbers[3 * i + k];
      state.motion[physics::velocity_of(vertex) + k] = omega_ * numbers[3 * (vertex_count_ + i) + k];
    }
  return state;
}

void PeerSystem::rates(const double* y, double* rates) {
  const std::size_t half = 3 * vertex_count_;
  const ModelBody& body = model_.bodies.front();
  const double unit_force = body.unit_force(), to_rate = 1 / (body.vertex_mass * omega_);
  sum_springs(y);
  for (std::size_t k = 0; k < half; ++k) rates[k] = omega_ * y[half + k];
  for (std::size_t i = 0; i < vertex_count_; ++i) {
    const glm::dvec3 force = -unit_force * sums_[i];
    const double damping = damping_rate(force);
    for (std::size_t k = 0; k < 3; ++k)
      rates[half + 3 * i + k] = to_rate * force[static_cast<int>(k)] - damping * y[half + 3 * i + k];
  }
}

void PeerSystem::accelerations(const double* u, double* scaled) {
  PLIANT_EXPECT(!is_damped());
  const ModelBody& body = model_.bodies.front();
  const double factor = -body.unit_force() / (body.vertex_mass * omega_ * omega_);
  sum_springs(u);
  for (std::size_t i = 0; i < vertex_count_; ++i)
    for (std::size_t k = 0; k < 3; ++k) scaled[3 * i + k] = factor * sums_[i][static_cast<int>(k)];
}

void PeerSystem::sum_springs(const double* u) {
  const double inverse_unit = 1 / model_.bodies.front().unit_of_length();
  for (std::size_t i = 0; i < vertex_count_; ++i) {
    displacements_[i] = glm::dvec4(inverse_unit * u[3 * i], inverse_unit * u[3 * i + 1], inverse_unit * u[3 * i + 2], 0.0);
    positions_[i] = rest_[i] + displacements_[i];
  }
  const auto count = static_cast<std::uint32_t>(vertex_count_);
  const cpu::SpringBody<double> body{positions_.data(), displacements_.data(), count, 0, count, sums_.data()};
  springs_.sum(pool_, {&body, 1});
  ++evaluations_;
}

double PeerSystem::damping_rate(const glm::dvec3& force) const {
  const ModelBody& body = model_.bodies.front();
  return physics::damping_rate(static_cast<std::uint32_t>(law_), body.damping, 1 / body.vertex_mass, glm::dot(force, force));
}

}  // namespace pliant::bench
