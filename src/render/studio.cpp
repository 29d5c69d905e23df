// Fits lights and maps to a scene's box.
#include "render/studio.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
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

glm::mat4 key_projection_for(double radius, const glm::dvec3& direction) {
  const double r = 1.15 * radius;
  const double half_depth = depth_per_width * r;
  const glm::dmat4 view = glm::lookAt(direction * (2 * r), glm::dvec3(0), glm::dvec3(0, 1, 0));
  return glm::mat4(glm::ortho(-r, r, -r, r, 2 * r - half_depth, 2 * r + half_depth) * view);
}

/// The map's depth runs from the ground up to the ceiling. The world's z is the map's y.
glm::mat4 above_projection_for(const glm::vec4& ground, float radius) {
  const float side = 1 / ground.w, height = 2 / (ceiling * radius);
  return {glm::vec4(side, 0, 0, 0), glm::vec4(0, 0, height, 0), glm::vec4(0, side, 0, 0),
          glm::vec4(-side * ground.x, -side * ground.z, -height * ground.y - 1, 1)};
}

}  // namespace

Studio studio_for(const RenderOptions& options) {
  const SceneBox& scene = options.scene;
  const glm::dvec3 key = key_direction_for(options.camera);
  Studio studio{};
  studio.key_projection = key_projection_for(scene.radius(), key);
  studio.key_direction = glm::vec4(key, 0.0);
  studio.centre = glm::vec4(scene.centre(), scene.radius());
  if (!options.ground_height) return studio;
  // The maps of the ground lie under the scene and reach out to where its shadows fall.
  const double height = *options.ground_height - double{studio.centre.y};
  const glm::dvec3 away = key * (height / key.y);
  const double half_side = std::max(2.2 * scene.radius(), 0.5 * std::hypot(away.x, away.z) + 1.6 * scene.radius());
  studio.ground = glm::vec4(0.5 * away.x, height, 0.5 * away.z, half_side);
  studio.above_projection = above_projection_for(studio.ground, studio.centre.w);
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
  studio.eye = glm::vec4(camera.eye, 0.5 * height / std::tan(0.5 * glm::radians(camera.field_of_view)));
}

}  // namespace pliant::render
