// Places the camera on a sphere around its target by azimuth and elevation.
#include "view/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace pliant::view {
namespace {

const double highest = glm::radians(87.0);  // above it axes_of takes another axis for the picture's top

/// Unit vector towards the eye.
glm::dvec3 direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

}  // namespace

CameraDescription orbit(const CameraDescription& camera, const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& size) {
  const glm::dvec2 drag = (to - from) / size;
  const glm::dvec3 back = render::axes_of(camera).back;
  const double azimuth = std::atan2(back.x, back.z) - 2 * std::numbers::pi * drag.x;
  const double before = std::asin(std::clamp(back.y, -1.0, 1.0));  // may exceed `highest` and is then kept
  const double elevation = std::clamp(before + std::numbers::pi * drag.y, std::min(-highest, before), std::max(highest, before));
  CameraDescription turned = camera;
  turned.eye = camera.target + glm::distance(camera.eye, camera.target) * direction(azimuth, elevation);
  return turned;
}

CameraDescription pan(const CameraDescription& camera, const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& size) {
  const double height = 2 * glm::distance(camera.eye, camera.target) * std::tan(glm::radians(camera.field_of_view) / 2);  // [m]
  const glm::dvec2 metres = (to - from) * (height / size.y);
  const render::CameraAxes axes = render::axes_of(camera);
  const glm::dvec3 shift = axes.up * metres.y - axes.right * metres.x;
  return {camera.eye + shift, camera.target + shift, camera.field_of_view};
}

CameraDescription zoom(const CameraDescription& camera, double notches) {
  CameraDescription nearer = camera;
  const double distance = glm::distance(camera.eye, camera.target);
  nearer.eye = camera.target + render::axes_of(camera).back * std::clamp(distance * std::pow(0.9, notches), 1e-6, 1e12);
  return nearer;
}

CameraDescription frame(const CameraDescription& camera, const render::SceneBox& box, const glm::dvec2& size) {
  return render::frame_from(render::axes_of(camera).back, box, size.x / size.y, camera.field_of_view);
}

}  // namespace pliant::view
