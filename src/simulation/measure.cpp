// Sums per vertex, then over vertices in order.
#include "simulation/measure.hpp"

#include <cmath>
#include <limits>

namespace pliant {
namespace {

// Rest positions and displacements, an array a coordinate, so that the compiler sums several springs at once.
struct Coordinates {
  std::vector<double> rest[3], moved[3];  // [m]

  Coordinates(const Model& model, const State& state) {
    for (int axis = 0; axis < 3; ++axis) {
      rest[axis].resize(model.vertex_count());
      moved[axis].resize(model.vertex_count());
      for (std::uint32_t i = 0; i < model.vertex_count(); ++i) {
        rest[axis][i] = static_cast<double>(model.rest_positions[i][axis]);
        moved[axis][i] = state.motion[std::size_t{6} * i + static_cast<std::size_t>(axis)];
      }
    }
  }
};

// (|x| - L)^2 [m^2] of the spring between two vertices, without cancellation: with r from one to the other at rest, d its change,
// and x = r + d, it is (|x|^2 - L^2)^2 / (|x| + L)^2, and |x|^2 - L^2 = d.(r + x). One factor is divided before the other comes
// in, so that only an energy that is beyond all numbers overflows.
inline double elongation_squared(const Coordinates& at, std::size_t i, std::size_t j) {
  double now = 0, rest = 0, growth = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double r = at.rest[axis][i] - at.rest[axis][j], d = at.moved[axis][i] - at.moved[axis][j], x = r + d;
    now += x * x;
    rest += r * r;
    growth += d * (r + x);
  }
  constexpr double least = std::numeric_limits<double>::min();  // of two vertices that share a place, in both shapes
  return growth * (growth / (now + rest + 2 * std::sqrt(now * rest) + least));
}

// The sum of (|x| - L)^2 [m^2] over the springs from `i` to the vertices from `i` + 1 to before `end`.
double sum_of_springs(const Coordinates& at, std::size_t i, std::size_t end) {
  constexpr std::size_t lanes = 8;
  double sums[lanes] = {};
  std::size_t j = i + 1;
  for (; j + lanes <= end; j += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += elongation_squared(at, i, j + lane);
  for (std::size_t lane = 0; j + lane < end; ++lane) sums[lane] += elongation_squared(at, i, j + lane);
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

// A vertex: the energy of its springs to later vertices of its body [J]; NaN from where it was stopped.
std::vector<double> elastic_energies(const Model& model, const State& state, ThreadPool& pool,
                                     const std::function<bool()>& stopped) {
  const Coordinates at(model, state);
  std::vector<double> energies(model.vertex_count(), std::numeric_limits<double>::quiet_NaN());
  pool.for_ranges(model.vertex_count(), 16, [&](std::uint32_t first, std::uint32_t end) {
    if (stopped && stopped()) return;
    for (std::uint32_t i = first; i < end; ++i) {
      const ModelBody& body = model.body_of(i);
      energies[i] = 0.5 * body.stiffness * sum_of_springs(at, i, body.first_vertex + body.vertex_count);
    }
  });
  return energies;
}

}  // namespace

Measurement measure(const Model& model, const State& state, const glm::dvec3& gravity, ThreadPool& pool,
                    const std::function<bool()>& stopped) {
  const std::vector<double> elastic = elastic_energies(model, state, pool, stopped);
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
