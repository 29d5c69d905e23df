// Makes bodies from meshes. A mesh's vertex v has the world position position + R (centroid + stretch * (scale v - centroid)).
#include "model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include "core/expect.hpp"
#include "mesh/report.hpp"
#include "model/body_error.hpp"
#include "model/inflation.hpp"
#include "model/pose.hpp"

namespace pliant {
namespace {

constexpr double largest_coordinate = 1e9;  // [m]
constexpr double smallest_radius = 1e-6;    // [m]
constexpr std::size_t most_bodies = 65535;  // because pairs of bodies are counted in 32 bits

glm::dvec3 mean(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

std::vector<glm::dvec3> scaled_positions(const BodySetup& setup) {
  std::vector<glm::dvec3> positions = setup.mesh.positions;
  for (glm::dvec3& position : positions) position *= setup.description.scale;
  return positions;
}

int winding_of(const TriangleMesh& mesh) {
  const MeshReport report = report_mesh(mesh);
  const bool is_sphere = report.manifold && report.component_count == 1 && report.genus == 0;
  return is_sphere && report.volume ? (*report.volume > 0 ? 1 : -1) : 0;
}

ModelBody describe_body(const BodySetup& setup, const Model& model) {
  const BodyDescription& description = setup.description;
  const double n = static_cast<double>(setup.mesh.positions.size());
  ModelBody body;
  body.name = description.name;
  body.first_vertex = model.vertex_count();
  body.vertex_count = static_cast<std::uint32_t>(setup.mesh.positions.size());
  body.first_triangle = static_cast<std::uint32_t>(model.triangles.size());
  body.triangle_count = static_cast<std::uint32_t>(setup.mesh.triangles.size());
  body.stiffness = description.total_stiffness ? *description.total_stiffness / (n * n) : description.stiffness;
  body.vertex_mass = description.total_mass ? *description.total_mass / n : description.vertex_mass;
  body.damping = description.damping;
  body.kind = description.kind;
  body.is_container = description.is_container;
  if (body.is_rigid())
    body.stiffness = body.damping = 0;
  else
    body.forces = description.forces;
  body.force_tolerance = description.force_tolerance;
  body.is_clustered = body.forces == ForceSum::clustered;
  body.surface = description.surface;
  body.restitution = description.restitution;
  body.self_contact = description.self_contact;
  if (body.self_contact) body.winding = winding_of(setup.mesh);
  body.color = description.color;
  return body;
}

/// Appends the body's rest shape, centred on `centroid`.
void append_shape(const BodySetup& setup, const std::vector<glm::dvec3>& positions, const glm::dvec3& centroid, Model& model) {
  ModelBody body = describe_body(setup, model);
  const auto index = static_cast<float>(model.bodies.size());
  for (const glm::dvec3& position : positions) {
    model.rest_positions.emplace_back(glm::vec3(position - centroid), index);
    body.radius = std::max(body.radius, glm::length(model.rest_position(model.rest_positions.size() - 1)));
  }
  for (const auto& [a, b, c] : setup.mesh.triangles)
    model.triangles.push_back({body.first_vertex + a, body.first_vertex + b, body.first_vertex + c});
  if (setup.description.pressure > 0) body.inflation = inflate(setup, model, body);
  model.bodies.push_back(std::move(body));
}

/// Appends the motion of the body that was added last: stretched, moving and spinning about its world centroid.
void append_motion(const BodyDescription& description, const Model& model, State& state) {
  const ModelBody& body = model.bodies.back();
  physics::Pose& pose = state.poses.back();
  std::vector<glm::dvec3> displacements, world;
  for (std::size_t i = 0; i < body.vertex_count; ++i) {
    const glm::dvec3 rest = model.rest_position(body.first_vertex + i);
    displacements.push_back((description.stretch - 1.0) * rest);
    world.push_back(physics::to_world(pose, rest + displacements.back()));
  }
  STORE3(pose.reference, 0, displacements.front());
  const glm::dvec3 centroid = mean(world);
  const glm::dquat q(pose.quaternion[3], pose.quaternion[0], pose.quaternion[1], pose.quaternion[2]);
  const glm::dmat3 to_frame = glm::transpose(glm::mat3_cast(q));
  for (std::size_t i = 0; i < body.vertex_count; ++i) {
    const glm::dvec3 velocity = description.velocity + glm::cross(description.spin, world[i] - centroid);
    const glm::dvec3 u = displacements[i], w = to_frame * velocity;
    state.motion.insert(state.motion.end(), {u.x, u.y, u.z, w.x, w.y, w.z});
  }
}

// Where a scripted body starts, and how it moves there.
void append_start(const BodyPath& path, const glm::dvec3& gravity, const Model& model, State& state) {
  const ModelBody& body = model.bodies.back();
  const physics::PathPoint start = path.at(0);
  const glm::dquat q(start.quaternion[3], start.quaternion[0], start.quaternion[1], start.quaternion[2]);
  state.poses.push_back(make_pose(glm::make_vec3(start.centre), q, gravity));
  for (std::size_t i = 0; i < body.vertex_count; ++i) {
    const glm::dvec3 from_centre = physics::rotate(state.poses.back(), model.rest_position(body.first_vertex + i));
    const glm::dvec3 velocity = glm::make_vec3(start.velocity) + glm::cross(glm::make_vec3(start.spin), from_centre);
    const glm::dvec3 w = physics::rotate_back(state.poses.back(), velocity);
    state.motion.insert(state.motion.end(), {0, 0, 0, w.x, w.y, w.z});
  }
}

/// NaN counts as out of reach too.
bool out_of_reach(const glm::dvec3& value) {
  const glm::dvec3 size = glm::abs(value);
  return !(size.x <= largest_coordinate && size.y <= largest_coordinate && size.z <= largest_coordinate);
}

void check_start(std::span<const BodySetup> setups, const ModelAndState& built) {
  const std::vector<glm::dvec3> positions = built.state.world_positions(built.model);
  const std::vector<glm::dvec3> velocities = built.state.world_velocities(built.model);
  for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
    const BodyDescription& body = setups[built.model.body_index(vertex)].description;
    if (out_of_reach(positions[vertex]))
      throw body_error(body, fmt::format("vertices stand beyond {} m", largest_coordinate),
                       "use a smaller scale, stretch or position");
    if (out_of_reach(velocities[vertex]))
      throw body_error(body, fmt::format("vertices move faster than {} m/s", largest_coordinate),
                       "use a smaller velocity or spin");
  }
}

void expect_room_for(std::size_t count, const BodyDescription& last) {
  if (count > most_bodies)
    throw body_error(last, fmt::format("is one of {} bodies", count),
                     fmt::format("leave bodies out: there may be {}", most_bodies));
}

// Pressure turns infinite as the volume goes to zero.
void expect_not_flattened(const BodyDescription& description) {
  const glm::dvec3& stretch = description.stretch;
  const double volume = stretch.x * stretch.y * stretch.z;
  if (description.pressure > 0 && !(volume > 1e-6))
    throw body_error(description,
                     fmt::format("pressure needs a volume, but stretch brings the body to {:.3g} of its rest volume", volume),
                     "use a stretch above zero along each axis, or leave the pressure out");
}

// The squares of a tiny normal would underflow.
glm::dvec3 direction_of(const glm::dvec3& vector) {
  return glm::normalize(vector / std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)}));
}

Ground make_ground(const GroundDescription& description) {
  const glm::dvec3 normal = direction_of(description.normal);
  return {.normal = normal,
          .offset = glm::dot(normal, description.point),
          .surface = description.surface,
          .where = description.where};
}

void expect_within_reach(const BodyDescription& description, const BodyPath& path) {
  constexpr double fastest_spin = 1e9;  // [rad/s]
  if (!(path.fastest_spin() <= fastest_spin))
    throw body_error(description, fmt::format("it turns faster than {} rad/s", fastest_spin),
                     description.path.empty() ? "give it a smaller spin" : "give its keys more time, or smaller rotations");
  if (!(path.highest_speed() <= largest_coordinate))
    throw body_error(
        description, fmt::format("it moves faster than {} m/s", largest_coordinate),
        description.path.empty() ? "give it a smaller velocity" : "give its keys more time, or bring them nearer to each other");
}

void append_body(const BodySetup& setup, const glm::dvec3& gravity, ModelAndState& built) {
  const BodyDescription& description = setup.description;
  if (setup.mesh.positions.empty()) throw body_error(description, "the mesh has no vertices", "use a mesh with a surface");
  expect_not_flattened(description);
  const std::vector<glm::dvec3> positions = scaled_positions(setup);
  const glm::dvec3 centroid = mean(positions);
  append_shape(setup, positions, centroid, built.model);
  if (!setup.mesh.triangles.empty() && built.model.bodies.back().radius < smallest_radius)
    throw body_error(description, fmt::format("the body is smaller than {} m, where forces in fp32 underflow", smallest_radius),
                     "use a larger scale, with other units if need be");
  if (description.kind == BodyKind::scripted) {
    BodyPath path = make_path(description, centroid);
    expect_within_reach(description, path);
    append_start(path, gravity, built.model, built.state);
    built.model.bodies.back().path = std::move(path);
    return;
  }
  const glm::dquat rotation = rotation_of(description.rotation);
  built.state.poses.push_back(make_pose(description.position + glm::mat3_cast(rotation) * centroid, rotation, gravity));
  append_motion(description, built.model, built.state);
}

// Appends a copy of a body, in the same state.
void append_copy(const ModelAndState& from, std::size_t index, ModelAndState& to) {
  ModelBody body = from.model.bodies[index];
  const std::uint32_t vertices_before = body.first_vertex, triangles_before = body.first_triangle;
  body.first_vertex = to.model.vertex_count();
  body.first_triangle = static_cast<std::uint32_t>(to.model.triangles.size());
  for (std::size_t i = vertices_before; i < std::size_t{vertices_before} + body.vertex_count; ++i)
    to.model.rest_positions.emplace_back(glm::vec3(from.model.rest_positions[i]), static_cast<float>(to.model.bodies.size()));
  for (std::size_t t = triangles_before; t < std::size_t{triangles_before} + body.triangle_count; ++t) {
    std::array<std::uint32_t, 3> corners = from.model.triangles[t];
    for (std::uint32_t& corner : corners) corner = corner - vertices_before + body.first_vertex;
    to.model.triangles.push_back(corners);
  }
  const auto motion = from.state.motion.begin() + std::ptrdiff_t{physics::motion_size} * vertices_before;
  to.state.motion.insert(to.state.motion.end(), motion, motion + std::ptrdiff_t{physics::motion_size} * body.vertex_count);
  to.state.poses.push_back(from.state.poses[index]);
  to.state.path_times.push_back(from.state.path_times.empty() ? 0 : from.state.path_times[index]);
  to.state.changed_sums.push_back(from.state.changed_sums.empty() ? nullptr : from.state.changed_sums[index]);
  to.model.bodies.push_back(std::move(body));
}

ModelAndState without_bodies(const ModelAndState& bodies) {
  ModelAndState none;
  none.model.grounds = bodies.model.grounds;
  return none;
}

// Of each body the loop keeps its own copy of the frame, so that the compiler need not read it again for each vertex.
template <class Of>
void fill_by_body(const Model& model, const std::vector<physics::Pose>& poses, std::span<glm::dvec3> into, const Of& of) {
  PLIANT_EXPECT(into.size() == model.vertex_count());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const physics::Pose pose = poses[b];
    const std::size_t first = model.bodies[b].first_vertex, end = first + model.bodies[b].vertex_count;
    for (std::size_t vertex = first; vertex < end; ++vertex) into[vertex] = of(pose, vertex);
  }
}

}  // namespace

ModelAndState with_body(const ModelAndState& bodies, std::size_t index, const BodySetup& setup, const glm::dvec3& gravity) {
  PLIANT_EXPECT(index <= bodies.model.bodies.size());
  expect_room_for(bodies.model.bodies.size() + 1, setup.description);
  ModelAndState result = without_bodies(bodies);
  for (std::size_t b = 0; b < index; ++b) append_copy(bodies, b, result);
  append_body(setup, gravity, result);
  result.state.path_times.push_back(0);
  result.state.changed_sums.push_back(nullptr);
  for (std::size_t b = index; b < bodies.model.bodies.size(); ++b) append_copy(bodies, b, result);
  return result;
}

ModelAndState without_body(const ModelAndState& bodies, std::size_t index) {
  PLIANT_EXPECT(index < bodies.model.bodies.size());
  ModelAndState result = without_bodies(bodies);
  for (std::size_t b = 0; b < bodies.model.bodies.size(); ++b)
    if (b != index) append_copy(bodies, b, result);
  return result;
}

bool Model::has_surfaces_to_touch() const {
  return !triangles.empty() && (bodies.size() > 1 || std::ranges::any_of(bodies, &ModelBody::self_contact));
}

double ModelBody::unit_of_length() const { return radius > 0 ? std::exp2(std::round(std::log2(radius))) : 1.0; }

std::vector<Material> materials_of(const Model& model) {
  std::vector<Material> materials;
  for (const ModelBody& body : model.bodies) materials.push_back({body.stiffness, body.vertex_mass, body.damping});
  return materials;
}

Model with_materials(Model model, std::span<const Material> materials) {
  PLIANT_EXPECT(materials.size() == model.bodies.size());
  for (std::size_t b = 0; b < materials.size(); ++b) {
    ModelBody& body = model.bodies[b];
    if (body.is_rigid()) continue;
    body.stiffness = materials[b].stiffness;
    body.vertex_mass = materials[b].vertex_mass;
    body.damping = materials[b].damping;
  }
  return model;
}

void State::read_world_positions(const Model& model, std::span<glm::dvec3> into) const {
  fill_by_body(model, poses, into, [&](const physics::Pose& pose, std::size_t vertex) {
    return physics::to_world(pose, model.rest_position(vertex) + displacement(vertex));
  });
}

void State::read_world_velocities(const Model& model, std::span<glm::dvec3> into) const {
  fill_by_body(model, poses, into,
               [&](const physics::Pose& pose, std::size_t vertex) { return physics::rotate(pose, velocity(vertex)); });
}

std::vector<glm::dvec3> State::world_positions(const Model& model) const {
  std::vector<glm::dvec3> positions(model.vertex_count());
  read_world_positions(model, positions);
  return positions;
}

std::vector<glm::dvec3> Model::rest_positions_of(const ModelBody& body) const {
  std::vector<glm::dvec3> positions;
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i) positions.push_back(rest_position(i));
  return positions;
}

std::vector<glm::dvec3> State::displacements_of(const ModelBody& body) const {
  std::vector<glm::dvec3> displacements;
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i)
    displacements.push_back(displacement(i));
  return displacements;
}

std::vector<glm::dvec3> State::world_velocities(const Model& model) const {
  std::vector<glm::dvec3> velocities(model.vertex_count());
  read_world_velocities(model, velocities);
  return velocities;
}

ModelAndState build_model(std::span<const BodySetup> setups, const glm::dvec3& gravity,
                          std::span<const GroundDescription> grounds) {
  if (setups.size() > most_bodies) expect_room_for(setups.size(), setups[most_bodies].description);
  ModelAndState built;
  for (const GroundDescription& ground : grounds) built.model.grounds.push_back(make_ground(ground));
  for (const BodySetup& setup : setups) append_body(setup, gravity, built);
  check_start(setups, built);
  return built;
}

}  // namespace pliant
