// Where a scene is seen from.
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "scene/scene_description.hpp"

namespace pliant::render {

/// The axis-aligned box in which a scene plays [m].
struct SceneBox {
  glm::dvec3 low{-1.0}, high{1.0};
  [[nodiscard]] glm::dvec3 centre() const { return (low + high) * 0.5; }
  /// Half the diagonal, or 1 m for a box that is a point.
  [[nodiscard]] double radius() const;
};

/// Returns a corner of the box. Bits 0, 1 and 2 of `bits` choose the high x, y and z.
[[nodiscard]] glm::dvec3 corner_of(const SceneBox& box, unsigned bits);

/// Returns the box around all finite places, or the default box if there are none.
[[nodiscard]] SceneBox box_around(std::span<const glm::dvec3> places);

/// Returns a camera on the side of the box that the unit vector `back` points to. The picture shows the whole box with a margin
/// around it. `aspect` is width / height, and `field_of_view` is vertical [degrees].
[[nodiscard]] CameraDescription frame_from(const glm::dvec3& back, const SceneBox& box, double aspect, double field_of_view);

/// Returns a three-quarter view from the front and slightly above, made by frame_from.
[[nodiscard]] CameraDescription frame_scene(const SceneBox& box, double aspect);

/// Returns the height of a ground plane just below the box [m].
[[nodiscard]] double ground_below(const SceneBox& box);

/// Unit vectors of a camera's picture: to its right, to its top, and from the target to the eye.
struct CameraAxes {
  glm::dvec3 right, up, back;
};
[[nodiscard]] CameraAxes axes_of(const CameraDescription& camera);

/// Returns the matrix from world to clip space, in which y is up.
[[nodiscard]] glm::dmat4 view_projection(const CameraDescription& camera, double aspect);

}  // namespace pliant::render
