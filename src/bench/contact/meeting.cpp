#include "bench/contact/meeting.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <span>

#include "dynamics/stability.hpp"
#include "model/mean_edge.hpp"

namespace pliant::bench {
namespace {

// Returns the mesh about its centroid, with a radius of 1.
TriangleMesh normalized(TriangleMesh mesh) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& p : mesh.positions) sum += p;
  const glm::dvec3 centroid = sum / static_cast<double>(mesh.positions.size());
  double radius = 0;
  for (glm::dvec3& p : mesh.positions) radius = std::max(radius, glm::length(p -= centroid));
  for (glm::dvec3& p : mesh.positions) p /= radius;
  return mesh;
}

// Meshes with symmetries meet in ties that rounding would decide, so both are turned.
BodySetup setup_of(const Partner& partner, double side /* -1: left */, double off_centre, double stretch) {
  BodySetup setup;
  setup.mesh = normalized(partner.mesh);
  BodyDescription& body = setup.description;
  body.name = side < 0 ? "left" : "right";
  body.scale = partner.radius;
  body.total_mass = partner.mass;
  body.total_stiffness = partner.stiffness;
  body.damping = 0;
  body.rotation = {10 * side, 20, 0};
  body.stretch.x = stretch;
  body.position = {0, off_centre * side, off_centre * side / 3};
  return setup;
}

double lowest_x(const ModelAndState& built) {
  double lowest = 1e300;
  for (const glm::dvec3& p : built.state.world_positions(built.model)) lowest = std::min(lowest, p.x);
  return lowest;
}

double highest_x(const ModelAndState& built) {
  double highest = -1e300;
  for (const glm::dvec3& p : built.state.world_positions(built.model)) highest = std::max(highest, p.x);
  return highest;
}

ModelAndState alone(const BodySetup& setup) { return build_model({&setup, 1}, glm::dvec3(0.0)); }

}  // namespace

Meeting meeting_of(const Partner& left, const Partner& right, const Encounter& how) {
  const double off_centre = how.off_centre * std::min(left.radius, right.radius);
  std::array<BodySetup, 2> setups = {setup_of(left, -1, off_centre, how.stretch), setup_of(right, 1, off_centre, how.stretch)};
  Meeting meeting{.start = {}, .time_step = 1e300, .edge = 1e300, .speed = 0};
  for (const BodySetup& setup : setups) {
    const ModelAndState built = alone(setup);
    meeting.time_step = std::min(meeting.time_step, how.omega_step / stiffest_frequency(built.model.bodies[0]));
    meeting.edge = std::min(meeting.edge, mean_edge(built.model, built.model.bodies[0]));
  }
  meeting.speed = how.edges_a_step * meeting.edge / meeting.time_step;
  const double distance = std::max(how.distance, how.edges_a_step) * meeting.edge;
  setups[0].description.position.x -= highest_x(alone(setups[0])) + distance / 2;
  setups[1].description.position.x += distance / 2 - lowest_x(alone(setups[1]));
  const double left_part = how.left_comes ? 1 : right.mass / (left.mass + right.mass);
  setups[0].description.velocity.x = left_part * meeting.speed;
  setups[1].description.velocity.x = -(1 - left_part) * meeting.speed;
  for (BodySetup& setup : setups) setup.description.position += how.far_away;
  meeting.start = build_model(setups, glm::dvec3(0.0));
  return meeting;
}

}  // namespace pliant::bench
