#include "view/present_scene.hpp"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "core/error.hpp"
#include "model/body_motion.hpp"

namespace pliant::view {
namespace {

bool has_moved(const ModelBody& body, std::size_t index, const State& start, const State& now) {
  const auto motion = [&](const State& state) {
    return std::span(state.motion)
        .subspan(physics::motion_size * std::size_t{body.first_vertex}, physics::motion_size * std::size_t{body.vertex_count});
  };
  return !std::ranges::equal(start.poses[index].origin, now.poses[index].origin) ||
         !std::ranges::equal(start.poses[index].quaternion, now.poses[index].quaternion) ||
         !std::ranges::equal(motion(start), motion(now));
}

// From the mesh's origin to its centroid, before the body is turned [m]. A path has it, because it may begin elsewhere.
glm::dvec3 arm_of(const ModelBody& body, const BodyDescription& description, const physics::Pose& start) {
  if (!description.path.empty()) return glm::make_vec3(body.path->way.arm);
  return physics::rotate_back(start, glm::make_vec3(start.origin) - description.position);
}

void place(BodyDescription& body, const BodyMotion& motion, const glm::dvec3& arm) {
  body.rotation = degrees_of(motion.rotation);
  body.position = motion.centre - rotation_of(body.rotation) * arm;
}

// The present motion of a scripted body may be less than its velocity and spin, because it may have to wait.
void go_on_from(BodyDescription& description, const BodyMotion& motion, const glm::dvec3& arm) {
  place(description, motion, arm);
  if (description.kind != BodyKind::soft) return;
  description.velocity = motion.velocity;
  description.spin = motion.spin;
  description.stretch = glm::dvec3(1.0);
}

void go_on_along_path(BodyDescription& description, double time, const BodyMotion& motion, const glm::dvec3& arm) {
  description.path = path_from(description, time);
  if (description.path.size() > 1) return;
  place(description, motion, arm);
  description.kind = BodyKind::immovable;
  description.path.clear();
}

// Totals stay where they give the material that the body has.
void take_material(BodyDescription& description, const ModelBody& body) {
  const double n = body.vertex_count;
  if (body.is_rigid()) return;
  if (!description.total_stiffness || *description.total_stiffness / (n * n) != body.stiffness) {
    description.total_stiffness.reset();
    description.stiffness = body.stiffness;
  }
  if (!description.total_mass || *description.total_mass / n != body.vertex_mass) {
    description.total_mass.reset();
    description.vertex_mass = body.vertex_mass;
  }
  description.damping = body.damping;
}

}  // namespace

SceneDescription present_scene(Session& session) {
  if (session.breakdown())
    throw Error(ErrorKind::input, "", "the state is not finite, so it is no scene", "go back, or to the start");
  SceneDescription scene = session.scene();
  const Model& model = session.model();
  const State &start = session.start(), now = session.simulation().state();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    BodyDescription& description = scene.bodies[b];
    take_material(description, model.bodies[b]);
    const glm::dvec3 arm = arm_of(model.bodies[b], description, start.poses[b]);
    if (!description.path.empty())
      go_on_along_path(description, now.path_times[b], body_motion(model, now, b), arm);
    else if (has_moved(model.bodies[b], b, start, now))
      go_on_from(description, body_motion(model, now, b), arm);
  }
  if (session.hand()) scene.bodies.erase(scene.bodies.begin() + session.hand()->body);
  return scene;
}

}  // namespace pliant::view
