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

/// The corner with each coordinate from above where its bit is set: x has the lowest of three.
[[nodiscard]] glm::dvec3 corner_of(const SceneBox& box, unsigned bits);

/// Around the places that are finite; the default box if there are none.
[[nodiscard]] SceneBox box_around(std::span<const glm::dvec3> places);

/// A camera on the side of the box to which `back` points (unit length), with the whole box inside the picture and a margin
/// around it. `aspect` is width / height, `field_of_view` vertical [degrees].
[[nodiscard]] CameraDescription frame_from(const glm::dvec3& back, const SceneBox& box, double aspect, double field_of_view);

/// A three-quarter view from the front, slightly above, by frame_from.
[[nodiscard]] CameraDescription frame_scene(const SceneBox& box, double aspect);

/// Height of a ground plane just below the box [m].
[[nodiscard]] double ground_below(const SceneBox& box);

/// Unit vectors of a camera's picture: to its right, to its top, and from the target to the eye.
struct CameraAxes {
  glm::dvec3 right, up, back;
};
[[nodiscard]] CameraAxes axes_of(const CameraDescription& camera);

/// World to clip space; y is up in the picture.
[[nodiscard]] glm::dmat4 view_projection(const CameraDescription& camera, double aspect);

}  // namespace pliant::render
