// Finds what is in the world at a place of the picture.
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

/// Returns the ray of all points that are seen at `place` [pixels from the picture's top left]. `size` is the picture's [pixels].
[[nodiscard]] Ray ray_through(const CameraDescription& camera, const glm::dvec2& place, const glm::dvec2& size);

/// Finds the nearest triangle that the ray hits, and returns its corner next to the hit. Returns nothing if the ray hits none.
/// Near walls of containers do not count.
/// `positions` are those of the model's vertices [m].
[[nodiscard]] std::optional<std::uint32_t> pick_vertex(const Model& model, std::span<const glm::vec4> positions, const Ray& ray);

/// Returns where the ray meets the plane through `point` with this normal, or `point` if it does not meet it.
[[nodiscard]] glm::dvec3 meet_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal);

}  // namespace pliant::view
