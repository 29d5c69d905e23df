// Where a scene is seen from.
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "scene/scene_description.hpp"

namespace pliant::render {

/// The axis-aligned box in which a scene plays [m].
struct SceneBox {
  glm::dvec3 low{-1.0}, high{1.0};
  [[nodiscard]] glm::dvec3 centre() const { return (low + high) * 0.5; }
  /// Half the diagonal, or 1 m for a box that is a point.
  [[nodiscard]] double radius() const;
};

/// A three-quarter view from the front, slightly above, with the whole box inside the picture and a margin around it.
/// `aspect` is width / height.
[[nodiscard]] CameraDescription frame_scene(const SceneBox& box, double aspect);

/// Height of a ground plane just below the box [m].
[[nodiscard]] double ground_below(const SceneBox& box);

/// World to clip space; y is up in the picture.
[[nodiscard]] glm::dmat4 view_projection(const CameraDescription& camera, double aspect);

}  // namespace pliant::render
