#include "model/body_motion.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "physics/rigid_motion.glsl"

namespace pliant {
namespace {

// By Newton's method: a small turn of the rest shape about its centre lets the distances fall fastest where it is the spin of a
// body with this spread and this angular momentum. `correlation` is the sum of each place times its rest place.
glm::dquat nearest_rotation(const glm::dmat3& correlation) {
  constexpr int most_turns = 50;
  glm::dquat rotation(1, 0, 0, 0);
  for (int i = 0; i < most_turns; ++i) {
    const glm::dmat3 c = correlation * glm::transpose(glm::mat3_cast(rotation)), both = 0.5 * (c + glm::transpose(c));
    const glm::dvec3 moment(c[1].z - c[2].y, c[2].x - c[0].z, c[0].y - c[1].x);  // columns first
    const glm::dvec3 turn = physics::least_spin({both[0].x, both[1].y, both[2].z}, {both[0].y, both[1].z, both[2].x}, moment);
    const double angle = glm::length(turn);
    if (!(angle > 1e-15)) break;
    rotation = glm::normalize(glm::angleAxis(angle, turn / angle) * rotation);
  }
  return rotation;
}

}  // namespace

BodyMotion body_motion(const Model& model, const State& state, std::size_t b) {
  const ModelBody& body = model.bodies[b];
  const physics::Pose& pose = state.poses[b];
  physics::Moments moments = physics::no_moments();
  glm::dvec3 rest_mean(0.0), first = model.rest_position(body.first_vertex) + state.displacement(body.first_vertex);
  glm::dmat3 correlation(0.0);
  for (std::size_t i = body.first_vertex; i < std::size_t{body.first_vertex} + body.vertex_count; ++i) {
    const glm::dvec3 rest = model.rest_position(i), place = rest + state.displacement(i) - first;
    physics::add_vertex(moments, place, state.velocity(i));
    rest_mean += rest;
    correlation += glm::outerProduct(place, rest);
  }
  const double count = body.vertex_count;
  rest_mean /= count;
  correlation -= glm::outerProduct(glm::make_vec3(moments.place), rest_mean);
  const physics::RigidMotion motion = physics::rigid_motion_with(moments, count, first, glm::dvec3(0.0));
  const glm::dquat frame(pose.quaternion[3], pose.quaternion[0], pose.quaternion[1], pose.quaternion[2]);
  return {.centre = physics::to_world(pose, glm::make_vec3(motion.centre)),
          .rotation = frame * nearest_rotation(correlation),
          .velocity = physics::rotate(pose, glm::make_vec3(motion.velocity)),
          .spin = physics::rotate(pose, glm::make_vec3(motion.spin))};
}

}  // namespace pliant
