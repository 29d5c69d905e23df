// Makes the frame of a body.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "physics/body.glsl"

namespace pliant {

/// Returns a frame at `origin` [m], turned by `rotation`. `gravity` is that of the world [m/s^2].
[[nodiscard]] physics::Pose make_pose(const glm::dvec3& origin, const glm::dquat& rotation, const glm::dvec3& gravity);

}  // namespace pliant
