#include "model/body_motion.hpp"

#include <Eigen/Eigenvalues>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "physics/rigid_motion.glsl"

namespace pliant {
namespace {

// B. K. P. Horn, "Closed-form solution of absolute orientation using unit quaternions" (1987). `correlation` is the sum of each
// place times its rest place. Where several rotations are as near, as for vertices on a line, it is the least one.
glm::dquat nearest_rotation(const glm::dmat3& correlation) {
  const auto s = [&](int rest, int place) { return correlation[rest][place]; };  // columns first
  const double trace = s(0, 0) + s(1, 1) + s(2, 2);
  Eigen::Matrix4d n;
  n.row(0) << trace, s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0);
  n.row(1) << n(0, 1), 2 * s(0, 0) - trace, s(0, 1) + s(1, 0), s(2, 0) + s(0, 2);
  n.row(2) << n(0, 2), n(1, 2), 2 * s(1, 1) - trace, s(1, 2) + s(2, 1);
  n.row(3) << n(0, 3), n(1, 3), n(2, 3), 2 * s(2, 2) - trace;
  n(0, 0) += 1e-14 * n.norm() + std::numeric_limits<double>::min();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(n);
  const Eigen::Vector4d q = solver.eigenvectors().col(3);  // that of the largest eigenvalue
  return glm::normalize(q[0] < 0 ? glm::dquat(-q[0], -q[1], -q[2], -q[3]) : glm::dquat(q[0], q[1], q[2], q[3]));
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
