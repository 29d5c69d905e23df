#include "model/place_body.hpp"

#include "core/expect.hpp"
#include "model/body_motion.hpp"
#include "model/pose.hpp"

namespace pliant {
namespace {

void set_displacements(State& state, const Model& model, const ModelBody& body, const physics::Pose& frame,
                       std::span<const glm::dvec3> positions) {
  const glm::dvec3 origin(frame.origin[0], frame.origin[1], frame.origin[2]);
  for (std::uint32_t k = 0; k < body.vertex_count; ++k) {
    const std::uint32_t vertex = body.first_vertex + k;
    const glm::dvec3 u = physics::rotate_back(frame, positions[k] - origin) - model.rest_position(vertex);
    STORE3(state.motion, physics::displacement_of(vertex), u)
  }
}

}  // namespace

void place_body(State& state, const Model& model, std::size_t b, std::span<const glm::dvec3> positions,
                const glm::dvec3& gravity) {
  const ModelBody& body = model.bodies[b];
  PLIANT_EXPECT(positions.size() == body.vertex_count);
  std::vector<glm::dvec3> velocities;
  for (std::uint32_t k = 0; k < body.vertex_count; ++k) velocities.push_back(state.world_velocity(model, body.first_vertex + k));
  physics::Pose& pose = state.poses[b];
  set_displacements(state, model, body, pose, positions);
  const BodyMotion motion = body_motion(model, state, b);
  pose = make_pose(motion.centre, motion.rotation, gravity);
  set_displacements(state, model, body, pose, positions);
  const glm::dvec3 reference = state.displacement(body.first_vertex);
  STORE3(pose.reference, 0, reference)
  set_velocities(state, model, b, velocities);
}

void set_velocities(State& state, const Model& model, std::size_t b, std::span<const glm::dvec3> velocities) {
  const ModelBody& body = model.bodies[b];
  PLIANT_EXPECT(velocities.size() == body.vertex_count);
  for (std::uint32_t k = 0; k < body.vertex_count; ++k) {
    const glm::dvec3 w = physics::rotate_back(state.poses[b], velocities[k]);
    STORE3(state.motion, physics::velocity_of(body.first_vertex + k), w)
  }
}

}  // namespace pliant
