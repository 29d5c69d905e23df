// A session's scene as it is in the present, to be saved.
#pragma once
#include "view/session.hpp"

namespace pliant::view {

/// Returns the description of a scene that begins with the session's bodies where they are, with its settings:
/// - A body that has moved has the place, velocity and spin that it has now, without its deformation. All others are as in the
///   scene.
/// - What is left of a path begins at rest, unless it repeats. A body whose path has ended is static.
/// - The hand is left out.
///
/// Throws Error if the state is not finite.
[[nodiscard]] SceneDescription present_scene(Session& session);

}  // namespace pliant::view
