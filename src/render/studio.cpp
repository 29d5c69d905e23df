// What the GPU has to know of a scene and of a camera.
#include "render/studio.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace pliant::render {
namespace {

glm::dvec3 key_direction_for(const CameraDescription& camera) {
  glm::dvec3 back = camera.eye - camera.target;
  back.y = 0;
  back = glm::length(back) > 0 ? glm::normalize(back) : glm::dvec3(0, 0, 1);
  const glm::dvec3 right = glm::cross(glm::dvec3(0, 1, 0), back);
  return glm::normalize(-0.55 * right + glm::dvec3(0, 1.15, 0) + 0.55 * back);
}

}  // namespace

Studio studio_for(const RenderOptions& options) {
  Studio studio{};
  studio.key_direction = glm::vec4(key_direction_for(options.camera), 0.0);
  studio.centre = glm::vec4(options.scene.centre(), options.scene.radius());
  if (options.ground_height) studio.ground = glm::vec4(0.0, *options.ground_height - double{studio.centre.y}, 0.0, 1.0);
  return studio;
}

void see_from(Studio& studio, const RenderOptions& options) {
  const double width = options.size.x, height = options.size.y;
  CameraDescription camera = options.camera;
  camera.eye -= glm::dvec3(studio.centre);
  camera.target -= glm::dvec3(studio.centre);
  const glm::dmat4 to_clip = view_projection(camera, width / height);
  studio.view_projection = glm::mat4(to_clip);
  studio.from_clip = glm::mat4(glm::inverse(to_clip));
  studio.target = glm::vec4(camera.target, 0.0);
  studio.eye = glm::vec4(camera.eye, 0.5 * height / std::tan(0.5 * glm::radians(camera.field_of_view)));
}

}  // namespace pliant::render
