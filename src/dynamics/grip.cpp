// Bounds depend on the body's radius r and its stiffest frequency omega. Think of a vertex that is held back only by springs. It
// moves by a / omega^2 under an acceleration a, and swings by v / omega after a kick of v.
#include "dynamics/grip.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "dynamics/stability.hpp"

namespace pliant {
namespace {

constexpr double reach = 0.7;                  // of the grip, in radii
constexpr double largest_displacement = 0.25;  // by a steady pull, in radii
constexpr double largest_swing = 0.125;        // after one pull, in radii
constexpr double approach = 10;                // [1/s]: nine tenths of the way in a quarter of a second
constexpr double largest_speed = 15;           // in radii [1/s]

/// Returns 1 at the vertex itself, and falls smoothly to 0 at the grip's reach.
float weight_at(double distance /* in reaches */) {
  const double rest = 1 - distance * distance;
  return static_cast<float>(rest * rest);
}

std::vector<physics::GripVertex> grip_around(const Model& model, std::uint32_t vertex) {
  const ModelBody& body = model.body_of(vertex);
  std::vector<physics::GripVertex> grip{{vertex, 1.0f}};
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i) {
    const glm::dvec3 apart(glm::vec3(model.rest_positions[i] - model.rest_positions[vertex]));
    const double distance = glm::length(apart) / (reach * body.radius);
    if (i != vertex && distance < 1) grip.push_back({i, weight_at(distance)});
  }
  return grip;
}

}  // namespace

Grip::Grip(DeviceBodies& bodies, const Model& model, std::uint32_t vertex) : bodies_(bodies), vertex_(vertex) {
  const ModelBody& body = model.body_of(vertex);
  const double frequency = stiffest_frequency(body);
  largest_acceleration_ = largest_displacement * frequency * frequency * body.radius;
  largest_change_ = largest_swing * frequency * body.radius;
  aim_.approach = approach;
  aim_.largest_speed = std::min(largest_speed * body.radius, largest_change_);
  aim_.body = model.body_index(vertex);
  aim_.grip_count = static_cast<std::uint32_t>(bodies.arrays.make("grip", grip_around(model, vertex)).size());
  bodies.arrays.make<physics::Aim>("aim", 1);
}

void Grip::aim_at(const glm::dvec3& target, double seconds) {
  STORE3(aim_.target, 0, target)
  aim_.largest_change = std::min(largest_acceleration_ * seconds, largest_change_);
  bodies_.arrays.get<physics::Aim>("aim").upload(std::span(&aim_, 1));
}

std::vector<Pass> Grip::passes(std::uint32_t half) const {
  const std::uint32_t first_vertex = bodies_.first_of_half(half);
  return {make_pass(bodies_.arrays, "aim_pull", {{"first_vertex", first_vertex}}, 1),
          make_pass(bodies_.arrays, "pull_grip", {{"first_vertex", first_vertex}}, aim_.grip_count)};
}

}  // namespace pliant
