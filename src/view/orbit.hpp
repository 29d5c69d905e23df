// A camera that turns around its target, as a mouse moves it.
#pragma once
#include <glm/vec2.hpp>

#include "render/camera.hpp"

namespace pliant::view {

// Places in the picture are in pixels from its top left; `size` is the picture's [pixels].

/// Turns the camera around its target: by 2 pi where the mouse goes from the left edge to the right, so that the scene follows
/// it; by pi from top to bottom, but never over the poles.
[[nodiscard]] CameraDescription orbit(const CameraDescription& camera, const glm::dvec2& from, const glm::dvec2& to,
                                      const glm::dvec2& size);

/// Shifts the camera in its picture's plane: what was at `from`, as far away as the target, is at `to`.
[[nodiscard]] CameraDescription pan(const CameraDescription& camera, const glm::dvec2& from, const glm::dvec2& to,
                                    const glm::dvec2& size);

/// Takes the camera a tenth of the way to its target for each notch, or back for a negative one.
[[nodiscard]] CameraDescription zoom(const CameraDescription& camera, double notches);

/// Shows the whole box from the side from which the camera looks.
[[nodiscard]] CameraDescription frame(const CameraDescription& camera, const render::SceneBox& box, const glm::dvec2& size);

}  // namespace pliant::view
