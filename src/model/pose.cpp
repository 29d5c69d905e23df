#include "model/pose.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace pliant {

physics::Pose make_pose(const glm::dvec3& origin, const glm::dquat& q, const glm::dvec3& gravity) {
  physics::Pose pose{};
  const glm::dmat3 rotation = glm::mat3_cast(q);  // columns first
  const glm::dvec3 local_gravity = glm::transpose(rotation) * gravity;
  STORE3(pose.origin, 0, origin);
  STORE3(pose.gravity, 0, local_gravity);
  for (int i = 0; i < 4; ++i) pose.quaternion[i] = glm::dvec4(q.x, q.y, q.z, q.w)[i];
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) pose.rotation[3 * row + column] = rotation[column][row];
  return pose;
}

}  // namespace pliant
