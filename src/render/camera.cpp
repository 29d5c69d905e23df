// Fitting a camera to a box, and its matrices.
#include "render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace pliant::render {
namespace {

/// If the camera looks straight down or up, y can't say where the picture's top is, so -z does.
glm::dvec3 up_for(const glm::dvec3& forward) {
  return std::abs(forward.y) > 0.999 * glm::length(forward) ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
}

}  // namespace

double SceneBox::radius() const {
  const double half_diagonal = glm::length(high - low) * 0.5;
  return half_diagonal > 0 ? half_diagonal : 1.0;
}

glm::dvec3 corner_of(const SceneBox& box, unsigned bits) {
  return {bits & 1u ? box.high.x : box.low.x, bits & 2u ? box.high.y : box.low.y, bits & 4u ? box.high.z : box.low.z};
}

SceneBox box_around(std::span<const glm::dvec3> places) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  SceneBox box{glm::dvec3(infinity), glm::dvec3(-infinity)};
  for (const glm::dvec3& place : places) {
    if (!std::isfinite(place.x + place.y + place.z)) continue;
    box.low = glm::min(box.low, place);
    box.high = glm::max(box.high, place);
  }
  return box.low.x <= box.high.x ? box : SceneBox{};
}

CameraAxes axes_of(const CameraDescription& camera) {
  const glm::dvec3 away = camera.eye - camera.target;
  const double distance = glm::length(away);
  const glm::dvec3 back = distance > 0 ? away / distance : glm::dvec3(0, 0, 1);
  const glm::dvec3 right = glm::normalize(glm::cross(up_for(-back), back));
  return {right, glm::cross(back, right), back};
}

CameraDescription frame_from(const glm::dvec3& back, const SceneBox& box, double aspect, double field_of_view) {
  constexpr double filled = 0.94;
  const CameraAxes axes = axes_of({back, glm::dvec3(0.0), field_of_view});
  const double tangent = std::tan(glm::radians(field_of_view) * 0.5) * filled;
  double distance = box.radius() * 0.1;
  for (unsigned i = 0; i < 8; ++i) {
    const glm::dvec3 p = corner_of(box, i) - box.centre();
    const double half_height = std::max(std::abs(glm::dot(p, axes.up)), std::abs(glm::dot(p, axes.right)) / aspect);
    distance = std::max(distance, glm::dot(p, back) + half_height / tangent);
  }
  return {box.centre() + back * distance, box.centre(), field_of_view};
}

CameraDescription frame_scene(const SceneBox& box, double aspect) {
  return frame_from(glm::normalize(glm::dvec3(0.22, 0.32, 1.0)), box, aspect, 30.0);
}

double ground_below(const SceneBox& box) { return box.low.y - 0.01 * box.radius(); }

glm::dmat4 view_projection(const CameraDescription& camera, double aspect) {
  const glm::dvec3 forward = camera.target - camera.eye;
  const double distance = std::max(glm::length(forward), 1e-9);
  const glm::dmat4 projection = glm::perspective(glm::radians(camera.field_of_view), aspect, 0.01 * distance, 1000.0 * distance);
  return projection * glm::lookAt(camera.eye, camera.target, up_for(forward));
}

}  // namespace pliant::render
