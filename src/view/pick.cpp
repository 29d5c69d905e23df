#include "view/pick.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace pliant::view {
namespace {

using Corners = std::array<glm::dvec3, 3>;

/// Returns how far along the ray it hits a triangle, in lengths of the direction (Moeller and Trumbore, 1997).
std::optional<double> distance_to(const Corners& corners, const Ray& ray) {
  const glm::dvec3 along = corners[1] - corners[0], across = corners[2] - corners[0], side = glm::cross(ray.direction, across);
  const double determinant = glm::dot(along, side);
  if (determinant == 0) return {};
  const glm::dvec3 from = ray.origin - corners[0], other = glm::cross(from, along);
  const double u = glm::dot(from, side) / determinant, v = glm::dot(ray.direction, other) / determinant;
  const double distance = glm::dot(across, other) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && distance > 0)) return {};
  return distance;
}

// Containers show their far walls alone.
bool is_near_wall(const ModelBody& body, const Corners& corners, const Ray& ray) {
  return body.is_container && glm::dot(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), ray.direction) < 0;
}

}  // namespace

Ray ray_through(const CameraDescription& camera, const glm::dvec2& place, const glm::dvec2& size) {
  const render::CameraAxes axes = render::axes_of(camera);
  const double half_height = std::tan(glm::radians(camera.field_of_view) / 2);
  const double x = (2 * place.x / size.x - 1) * half_height * size.x / size.y, y = (1 - 2 * place.y / size.y) * half_height;
  return {camera.eye, axes.right * x + axes.up * y - axes.back};
}

std::optional<std::uint32_t> pick_vertex(const Model& model, std::span<const glm::vec4> positions, const Ray& ray) {
  std::optional<std::uint32_t> picked;
  double nearest = INFINITY;
  for (const std::array<std::uint32_t, 3>& triangle : model.triangles) {
    const auto corner = [&](std::size_t k) { return glm::dvec3(glm::vec3(positions[triangle[k]])); };
    const Corners corners{corner(0), corner(1), corner(2)};
    const std::optional<double> distance = distance_to(corners, ray);
    if (!distance || *distance >= nearest || is_near_wall(model.body_of(triangle[0]), corners, ray)) continue;
    nearest = *distance;
    const glm::dvec3 hit = ray.origin + nearest * ray.direction;
    std::size_t next = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (glm::distance(corners[k], hit) < glm::distance(corners[next], hit)) next = k;
    picked = triangle[next];
  }
  return picked;
}

glm::dvec3 meet_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal) {
  const double distance = glm::dot(point - ray.origin, normal) / glm::dot(ray.direction, normal);
  return std::isfinite(distance) && distance > 0 ? ray.origin + distance * ray.direction : point;
}

}  // namespace pliant::view
