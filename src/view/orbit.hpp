// Moves a camera as a mouse does: around its target, aside and nearer.
#pragma once
#include <glm/vec2.hpp>

#include "render/camera.hpp"

namespace pliant::view {

// Places are in pixels from the picture's top left. `size` is the picture's size [pixels].

/// Turns the camera around its target, so that the scene follows the mouse. A move across the picture's width turns it by 2 pi. A
/// move down the picture's height turns it by pi, but never over the poles.
[[nodiscard]] CameraDescription orbit(const CameraDescription& camera, const glm::dvec2& from, const glm::dvec2& to,
                                      const glm::dvec2& size);

/// Shifts the camera in its picture's plane. A point as far away as the target moves from `from` to `to`.
[[nodiscard]] CameraDescription pan(const CameraDescription& camera, const glm::dvec2& from, const glm::dvec2& to,
                                    const glm::dvec2& size);

/// Moves the camera a tenth of the way to its target for each notch, or back if `notches` is negative.
[[nodiscard]] CameraDescription zoom(const CameraDescription& camera, double notches);

/// Returns a camera that looks in the same direction and shows the whole box.
[[nodiscard]] CameraDescription frame(const CameraDescription& camera, const render::SceneBox& box, const glm::dvec2& size);

}  // namespace pliant::view
