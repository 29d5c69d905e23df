// Before each stage one dispatch sums the volumes in parts, and another gathers each vertex's triangles. The volume is a sum in a
// fixed order.
#include "dynamics/forces/pressure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mesh/incident_triangles.hpp"
#include "model/inflation.hpp"
#include "physics/forces/pressure.glsl"

namespace pliant {
namespace {

bool has_pressure(const ModelBody& body) { return !body.is_rigid() && body.inflation.pressure > 0; }

/// The arrays of all bodies with pressure.
struct Shells {
  std::vector<physics::Pressure> pressures;  // one for each body
  std::vector<std::uint32_t> triangles;      // three vertices each
  std::vector<glm::uvec4> parts;
  std::vector<std::uint32_t> fan_begins;
  std::vector<glm::uvec2> fans;
};

// Parts should be few, because every vertex of a body adds them up. They should be short, because one thread sums a part.
std::uint32_t part_length(std::uint32_t triangle_count) {
  return std::max<std::uint32_t>(8, static_cast<std::uint32_t>(std::sqrt(triangle_count)) / 4);
}

void add_parts(Shells& shells, std::uint32_t index, const ModelBody& body, std::uint32_t end) {
  physics::Pressure& pressure = shells.pressures[index];
  pressure = {.at_rest = body.inflation.pressure,
              .rest_volume = body.inflation.rest_volume,
              .is_gas = body.inflation.law == PressureLaw::gas,
              .first_part = static_cast<std::uint32_t>(shells.parts.size()),
              .part_count = 0,
              .padding = 0};
  const std::uint32_t length = part_length(body.triangle_count);
  for (std::uint32_t first = end - body.triangle_count; first < end; first += length)
    shells.parts.emplace_back(index, first, std::min(first + length, end), 0);
  pressure.part_count = static_cast<std::uint32_t>(shells.parts.size()) - pressure.first_part;
}

Shells shells_of(const Model& model) {
  Shells shells;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of bodies with pressure
  shells.pressures.resize(model.bodies.size());
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b) {
    const ModelBody& body = model.bodies[b];
    if (!has_pressure(body)) continue;
    const auto first = model.triangles.begin() + body.first_triangle;
    triangles.insert(triangles.end(), first, first + body.triangle_count);
    add_parts(shells, b, body, static_cast<std::uint32_t>(triangles.size()));
  }
  for (const auto& corners : triangles) shells.triangles.insert(shells.triangles.end(), corners.begin(), corners.end());
  IncidentTriangles fans = incident_triangles(model.vertex_count(), triangles);
  shells.fan_begins = std::move(fans.first);
  for (const auto& [next, after] : fans.others) shells.fans.emplace_back(next, after);
  return shells;
}

class AddedPressure final : public AddedForce {
 public:
  AddedPressure(DeviceBodies& bodies, const Shells& shells)
      : bodies_(bodies), part_count_(static_cast<std::uint32_t>(shells.parts.size())) {
    bodies.arrays.make("pressure", shells.pressures);
    bodies.arrays.make("shell_triangle", shells.triangles);
    bodies.arrays.make("shell_part", shells.parts);
    bodies.arrays.make<double>("volume_part", shells.parts.size());
    bodies.arrays.make("fan_begin", shells.fan_begins);
    bodies.arrays.make("fan", shells.fans);
  }

  std::vector<Pass> passes(std::uint32_t slot, bool is_first) const override {
    return {make_pass(bodies_.arrays, "sum_volume", {{"slot", slot}}, part_count_),
            make_pass(bodies_.arrays, "press", {{"slot", slot}, {"is_first", is_first ? 1u : 0u}}, bodies_.vertex_count)};
  }

 private:
  const DeviceBodies& bodies_;
  std::uint32_t part_count_;
};

std::unique_ptr<AddedForce> make_pressure(DeviceBodies& bodies, const Model& model) {
  return std::make_unique<AddedPressure>(bodies, shells_of(model));
}

// Returns the positions of a body's vertices in its frame.
std::vector<glm::dvec3> positions_of(const ModelBody& body, const Model& model, const State& state) {
  std::vector<glm::dvec3> positions(body.vertex_count);
  for (std::size_t k = 0; k < positions.size(); ++k)
    positions[k] = model.rest_position(body.first_vertex + k) + state.displacement(body.first_vertex + k);
  return positions;
}

double energy_at(const Inflation& inside, double volume) {
  if (!(volume > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (inside.law == PressureLaw::constant) return -inside.pressure * (volume - inside.rest_volume);
  return -inside.pressure * inside.rest_volume * std::log(volume / inside.rest_volume);
}

double pressure_energy(const EnergyQuestion& question) {
  const Model& model = question.model;
  double sum = 0;
  for (const ModelBody& body : model.bodies)
    if (has_pressure(body)) sum += energy_at(body.inflation, volume_of(model, body, positions_of(body, model, question.state)));
  return sum;
}

double pressure_energy_scale(const ModelBody& body) { return body.inflation.pressure * body.inflation.rest_volume; }

// For a gas the second derivative of the energy is p0 V0 / V^2 (dV/dx)^2 minus p times the second derivative of V. For a constant
// pressure the first term is zero. Returns a bound on its norm [N/m].
double stiffness_at(const Inflation& inside, const VolumeAt& at) {
  if (inside.law == PressureLaw::constant) return inside.pressure * at.curvature;
  const double pressure = inside.pressure * (inside.rest_volume / at.volume);
  return pressure * (at.gradient_squared / at.volume + at.curvature);
}

// The bound is stiffness_at() with half the rest volume, and with the derivatives at rest. Take a shape that is stretched by a, b
// and c along three axes, and a body with equal parts of (dV/dx)^2 along them. Then (dV/dx)^2 / V^2 is at most (1/a^2 + 1/b^2 +
// 1/c^2) / 3 times that at rest. The second derivative of V is at most max(a, b, c) times that at rest. So the bound holds down
// to V0 / 2 if the body is pressed along one axis, or evenly. It does not hold if a body is pressed flat and grows sideways, as
// by (2, 2, 1/8). It does not hold either if a constant pressure makes a body grow to more than twice its length.
constexpr double least_volume = 0.5;  // of the rest volume

double highest_stiffness(const Inflation& inside) {
  const double of_volume =
      inside.law == PressureLaw::gas ? inside.gradient_squared / (least_volume * least_volume * inside.rest_volume) : 0;
  const double of_shape = inside.curvature / least_volume;
  return inside.pressure * (of_volume + of_shape);
}

double pressure_frequency_squared(const ModelBody& body) { return highest_stiffness(body.inflation) / body.vertex_mass; }

std::optional<std::string> warning_of(const ModelBody& body, const VolumeAt& at) {
  constexpr const char* remedy = "use shorter steps, or a smaller tolerance if one governs them";
  if (at.volume < least_volume * body.inflation.rest_volume)
    return fmt::format("body \"{}\" was pressed below {} of its rest volume: the bound on steps holds only down to there, so {}",
                       body.name, least_volume, remedy);
  if (stiffness_at(body.inflation, at) > highest_stiffness(body.inflation))
    return fmt::format("body \"{}\" has a shape in which its pressure may be stiffer than the bound on steps assumes, so {}",
                       body.name, remedy);
  return {};
}

std::vector<std::string> pressure_warnings(const Model& model, const State& state) {
  std::vector<std::string> all;
  for (const ModelBody& body : model.bodies) {
    if (!has_pressure(body)) continue;
    const VolumeAt at = volume_at(model, body, positions_of(body, model, state));
    if (const auto warning = warning_of(body, at)) all.push_back(*warning);
  }
  return all;
}

}  // namespace

Force pressure() {
  return {.name = "pressure",
          .is_zero_at_rest = false,
          .acts_on = has_pressure,
          .energy = pressure_energy,
          .energy_scale = pressure_energy_scale,
          .frequency_squared = pressure_frequency_squared,
          .make = make_pressure,
          .warnings = pressure_warnings};
}

}  // namespace pliant
