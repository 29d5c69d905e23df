// From a place in the picture to what is there in the world.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

#include "model/model.hpp"
#include "render/camera.hpp"

namespace pliant::view {

struct Ray {
  glm::dvec3 origin{0.0};          // the camera's eye [m]
  glm::dvec3 direction{0, 0, -1};  // of any length
};

/// Along which a place lies that is seen at `place` [pixels from the picture's top left].
[[nodiscard]] Ray ray_through(const CameraDescription& camera, const glm::dvec2& place, const glm::dvec2& size);

/// Of the nearest triangle that the ray hits, the corner next to the hit. `positions` are those of the model's vertices [m].
[[nodiscard]] std::optional<std::uint32_t> pick_vertex(const Model& model, std::span<const glm::vec4> positions, const Ray& ray);

/// Where the ray meets the plane through `point` that faces along `normal`; `point` itself where it does not.
[[nodiscard]] glm::dvec3 meet_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal);

}  // namespace pliant::view
