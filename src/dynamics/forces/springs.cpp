// Energies are summed per vertex, then over vertices in order.
#include "dynamics/forces/springs.hpp"

#include <limits>

#include "dynamics/forces/elongations.hpp"

namespace pliant {
namespace {

struct Coordinates {
  std::vector<double> rest[3], moved[3];  // as SpringEnds has them

  Coordinates(const Model& model, const State& state) {
    for (int axis = 0; axis < 3; ++axis) {
      rest[axis].resize(model.vertex_count() + elongation_lanes);
      moved[axis].resize(model.vertex_count() + elongation_lanes);
      for (std::uint32_t i = 0; i < model.vertex_count(); ++i) {
        rest[axis][i] = static_cast<double>(model.rest_positions[i][axis]);
        moved[axis][i] = state.displacement(i)[axis];
      }
    }
  }

  [[nodiscard]] SpringEnds ends() const {
    return {{rest[0].data(), rest[1].data(), rest[2].data()}, {moved[0].data(), moved[1].data(), moved[2].data()}};
  }
};

// Returns for each vertex the energy of its springs to later vertices of its body [J]. Vertices that a stop leaves out have NaN.
std::vector<double> elastic_energies(const EnergyQuestion& question) {
  const auto& [model, state, pool, stopped] = question;
  const Coordinates coordinates(model, state);
  const SpringEnds ends = coordinates.ends();
  const ElongationSum sum_of_springs = elongation_sum(cpu::available_isas().back());
  std::vector<double> energies(model.vertex_count());
  for (std::uint32_t i = 0; i < model.vertex_count(); ++i)
    if (!model.body_of(i).is_static) energies[i] = std::numeric_limits<double>::quiet_NaN();
  pool.for_ranges(model.vertex_count(), 16, [&](std::uint32_t first, std::uint32_t end) {
    if (stopped && stopped()) return;
    for (std::uint32_t i = first; i < end; ++i) {
      const ModelBody& body = model.body_of(i);
      if (body.is_static) continue;
      energies[i] = 0.5 * body.stiffness * sum_of_springs(ends, i, body.first_vertex + body.vertex_count);
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
