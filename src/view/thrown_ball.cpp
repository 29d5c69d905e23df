#include "view/thrown_ball.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "dynamics/stability.hpp"
#include "mesh/generators.hpp"

namespace pliant::view {
namespace {

constexpr const char* ball_name = "thrown";

std::string free_name(const Model& model) {
  for (std::size_t number = 1;; ++number) {
    std::string name = fmt::format("{} {}", ball_name, number);
    if (std::ranges::find(model.bodies, name, &ModelBody::name) == model.bodies.end()) return name;
  }
}

}  // namespace

BodySetup ball_to_throw(const Model& model, double scene_radius, const Ray& ray, const glm::dvec3& gravity) {
  const double radius = 0.1 * scene_radius;
  const auto like = std::ranges::find_if(model.bodies, [](const ModelBody& body) { return !body.is_rigid(); });
  BodySetup setup{generate_mesh("icosphere:2"), {}};
  const double vertices = static_cast<double>(setup.mesh.positions.size());
  const glm::dvec3 direction = glm::normalize(ray.direction);
  BodyDescription& ball = setup.description;
  ball.name = free_name(model);
  ball.mesh = "icosphere:2";
  ball.scale = radius;
  ball.position = ray.origin + 2 * radius * direction;
  // across the scene in a second, or as fast as gravity makes it on the way to the middle
  ball.velocity = std::max(2 * scene_radius, std::sqrt(2 * glm::length(gravity) * scene_radius)) * direction;
  ball.color = default_color(model.bodies.size());
  if (like == model.bodies.end()) return setup;
  const double part = std::pow(radius / like->radius, 3);
  ball.total_mass = part * like->vertex_mass * like->vertex_count;
  ball.total_stiffness = *ball.total_mass * stiffest_frequency(*like) * stiffest_frequency(*like);
  ball.damping = like->damping / like->vertex_mass * *ball.total_mass / vertices;
  return setup;
}

}  // namespace pliant::view
