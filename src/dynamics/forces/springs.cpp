// Energies are summed per vertex, then over vertices in order.
#include "dynamics/forces/springs.hpp"

#include <cmath>
#include <limits>

namespace pliant {
namespace {

// Rest positions and displacements, with one array per coordinate so that the compiler sums several springs at once.
struct Coordinates {
  std::vector<double> rest[3], moved[3];  // [m]

  Coordinates(const Model& model, const State& state) {
    for (int axis = 0; axis < 3; ++axis) {
      rest[axis].resize(model.vertex_count());
      moved[axis].resize(model.vertex_count());
      for (std::uint32_t i = 0; i < model.vertex_count(); ++i) {
        rest[axis][i] = static_cast<double>(model.rest_positions[i][axis]);
        moved[axis][i] = state.displacement(i)[axis];
      }
    }
  }
};

// Returns (|x| - L)^2 [m^2] of the spring between two vertices, without cancellation. r leads from one to the other at rest, d is
// its change, and x = r + d. Then (|x| - L)^2 is (|x|^2 - L^2)^2 / (|x| + L)^2, and |x|^2 - L^2 = d.(r + x). One factor is
// divided before the other comes in, so that only an energy beyond all numbers overflows.
inline double elongation_squared(const Coordinates& at, std::size_t i, std::size_t j) {
  double now = 0, rest = 0, growth = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double r = at.rest[axis][i] - at.rest[axis][j], d = at.moved[axis][i] - at.moved[axis][j], x = r + d;
    now += x * x;
    rest += r * r;
    growth += d * (r + x);
  }
  constexpr double least = std::numeric_limits<double>::min();  // so that two vertices that share a place in both shapes give 0
  return growth * (growth / (now + rest + 2 * std::sqrt(now * rest) + least));
}

// Returns the sum of (|x| - L)^2 [m^2] over the springs from `i` to the vertices from `i` + 1 to before `end`.
double sum_of_springs(const Coordinates& at, std::size_t i, std::size_t end) {
  constexpr std::size_t lanes = 8;
  double sums[lanes] = {};
  std::size_t j = i + 1;
  for (; j + lanes <= end; j += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += elongation_squared(at, i, j + lane);
  for (std::size_t lane = 0; j + lane < end; ++lane) sums[lane] += elongation_squared(at, i, j + lane);
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

// Returns for each vertex the energy of its springs to later vertices of its body [J]. Vertices that a stop leaves out have NaN.
std::vector<double> elastic_energies(const EnergyQuestion& question) {
  const auto& [model, state, pool, stopped] = question;
  const Coordinates at(model, state);
  std::vector<double> energies(model.vertex_count());
  for (std::uint32_t i = 0; i < model.vertex_count(); ++i)
    if (!model.body_of(i).is_static) energies[i] = std::numeric_limits<double>::quiet_NaN();
  pool.for_ranges(model.vertex_count(), 16, [&](std::uint32_t first, std::uint32_t end) {
    if (stopped && stopped()) return;
    for (std::uint32_t i = first; i < end; ++i) {
      const ModelBody& body = model.body_of(i);
      if (body.is_static) continue;
      energies[i] = 0.5 * body.stiffness * sum_of_springs(at, i, body.first_vertex + body.vertex_count);
    }
  });
  return energies;
}

double spring_energy(const EnergyQuestion& question) {
  double sum = 0;
  for (const double energy : elastic_energies(question)) sum += energy;
  return sum;
}

double spring_energy_scale(const ModelBody& body) { return 0.5 * body.stiffness * body.radius * body.radius; }
double spring_frequency_squared(const ModelBody& body) { return body.vertex_count * body.stiffness / body.vertex_mass; }

}  // namespace

Force springs() {
  return {.name = "springs",
          .is_zero_at_rest = true,
          .acts_on = [](const ModelBody&) { return true; },
          .energy = spring_energy,
          .energy_scale = spring_energy_scale,
          .frequency_squared = spring_frequency_squared,
          .make = nullptr,
          .warnings = nullptr};
}

}  // namespace pliant
