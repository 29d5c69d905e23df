// The simulated bodies: what never changes (Model) and what does (State). Arrays are flat, and a body is a range in them.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "model/body_path.hpp"
#include "physics/body.glsl"
#include "physics/layout.glsl"
#include "scene/place_in_rows.hpp"
#include "scene/scene_description.hpp"

namespace pliant {

/// Pressure inside a closed surface, and what the bound on steps needs to know of the rest shape.
struct Inflation {
  double pressure = 0;  // at the rest volume, with nothing outside [Pa]. If 0, nothing below is known
  PressureLaw law = PressureLaw::gas;
  double rest_volume = 0;       // [m^3]
  double gradient_squared = 0;  // of the volume, summed over the vertices [m^4]
  double curvature = 0;         // at least the norm of the volume's second derivative [m]
};

/// A half-space that bodies stay out of: all points x with normal . x < offset.
struct Ground {
  glm::dvec3 normal{0.0, 1.0, 0.0};  // of length 1
  double offset = 0;                 // [m]
  SurfaceDescription surface;
  Origin where;  // in the scene, for errors about it
};

struct ModelBody {
  std::string name;
  BodyKind kind = BodyKind::soft;
  bool is_container = false;  // as in a BodyDescription
  std::uint32_t first_vertex = 0, vertex_count = 0;
  std::uint32_t first_triangle = 0, triangle_count = 0;
  double stiffness = 0;                   // k of every pair's spring [N/m]
  double vertex_mass = 1;                 // [kg]
  double damping = 0;                     // c [kg/s]
  double radius = 0;                      // largest distance of a rest position from the centroid [m]
  ForceSum forces = ForceSum::direct;     // of a rigid body direct
  std::optional<double> force_tolerance;  // as in a BodyDescription
  bool is_clustered = false;              // whether its springs are summed by clusters at first, see choose_force_sums()
  Inflation inflation;
  SurfaceDescription surface;
  std::optional<double> restitution;
  bool self_contact = false;  // as in a BodyDescription
  int winding = 0;        // of a body with self-contact, if its surface is of a sphere's kind: 1 if wound outward, -1 if inward
  glm::dvec3 color{1.0};  // linear RGB
  std::optional<BodyPath> path = {};  // of a scripted body

  /// Returns the name of the rows that the body is in, without its place in them. Of another body it is the body's own.
  [[nodiscard]] std::string_view name_of_rows() const { return std::string_view(name).substr(0, begin_of_place(name)); }
  /// Whether it keeps its shape and takes no impulses, as static and scripted bodies do. It has no springs.
  [[nodiscard]] bool is_rigid() const { return kind != BodyKind::soft; }
  /// Returns the unit of length in which springs are summed [m]. It is a power of two near the radius, so changes to it are
  /// exact.
  [[nodiscard]] double unit_of_length() const;
  /// Returns the force of a spring that is longer by that unit [N].
  [[nodiscard]] double unit_force() const { return stiffness * unit_of_length(); }
};

struct Model {
  std::vector<ModelBody> bodies;
  std::vector<Ground> grounds;
  std::vector<glm::vec4> rest_positions;  // xyz: relative to the centroid, in the body's frame, rounded once [m], w: body index
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into rest_positions

  [[nodiscard]] std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(rest_positions.size()); }
  [[nodiscard]] std::uint32_t body_index(std::size_t vertex) const {
    return static_cast<std::uint32_t>(rest_positions[vertex].w);
  }
  [[nodiscard]] glm::dvec3 rest_position(std::size_t vertex) const { return glm::dvec3(rest_positions[vertex]); }  // [m]
  [[nodiscard]] std::vector<glm::dvec3> rest_positions_of(const ModelBody& body) const;  // one for each of its vertices [m]
  [[nodiscard]] const ModelBody& body_of(std::size_t vertex) const { return bodies[body_index(vertex)]; }
  /// Returns whether there are two surfaces to touch: those of two bodies, or one that meets itself.
  [[nodiscard]] bool has_surfaces_to_touch() const;
};

struct Material {
  double stiffness = 0, vertex_mass = 1, damping = 0;  // as in a BodyDescription [N/m], [kg], [kg/s]
  bool operator==(const Material&) const = default;
};

/// Returns the material of each body. That of a rigid one says nothing.
[[nodiscard]] std::vector<Material> materials_of(const Model& model);
/// Returns the same bodies with other materials, one for each body. Rigid ones stay as they are.
[[nodiscard]] Model with_materials(Model model, std::span<const Material> materials);

/// How the springs of a clustered body are summed since a check has found its forces too inexact.
struct ChangedSums {
  std::uint32_t changes = 0;              // so far
  bool are_strained = false;              // no lists have met the tolerance, but they still beat sums of all springs
  bool are_direct = false;                // one by one. Nothing below is known then
  double accuracy = 0;                    // of lists of clusters (dynamics/clusters/cluster_pairs.hpp)
  std::vector<glm::dvec3> displacements;  // of a shape that lists suit beside the rest shape [m]

  bool operator==(const ChangedSums&) const = default;
};

/// Positions and velocities at one instant. Displacement u and velocity w live in the body's frame.
struct State {
  std::vector<physics::Pose> poses;  // one for each body
  std::vector<double> motion;        // 6 for each vertex: u [m], w [m/s]
  std::vector<double> path_times;    // of scripted bodies on their own clocks, one for each body [s]; empty: all are 0
  std::vector<std::shared_ptr<const ChangedSums>> changed_sums;  // one for each body, null if none have changed; empty: all are

  /// Return u [m] and w [m/s] of a vertex.
  [[nodiscard]] glm::dvec3 displacement(std::size_t vertex) const {
    return load(physics::displacement_of(static_cast<std::uint32_t>(vertex)));
  }
  [[nodiscard]] glm::dvec3 velocity(std::size_t vertex) const {
    return load(physics::velocity_of(static_cast<std::uint32_t>(vertex)));
  }
  /// Returns u of each vertex of a body [m].
  [[nodiscard]] std::vector<glm::dvec3> displacements_of(const ModelBody& body) const;
  /// Return the world position [m] and velocity [m/s] of a vertex, in fp64.
  [[nodiscard]] glm::dvec3 world_position(const Model& model, std::size_t vertex) const {
    return physics::to_world(poses[model.body_index(vertex)], model.rest_position(vertex) + displacement(vertex));
  }
  [[nodiscard]] glm::dvec3 world_velocity(const Model& model, std::size_t vertex) const {
    return physics::rotate(poses[model.body_index(vertex)], velocity(vertex));
  }
  /// Put those of every vertex into memory that is there, one for each.
  void read_world_positions(const Model& model, std::span<glm::dvec3> into) const;
  void read_world_velocities(const Model& model, std::span<glm::dvec3> into) const;
  /// Return those of every vertex.
  [[nodiscard]] std::vector<glm::dvec3> world_positions(const Model& model) const;
  [[nodiscard]] std::vector<glm::dvec3> world_velocities(const Model& model) const;

 private:
  [[nodiscard]] glm::dvec3 load(std::size_t first) const { return {motion[first], motion[first + 1], motion[first + 2]}; }
};

/// One body's mesh with its place and material.
struct BodySetup {
  TriangleMesh mesh;  // before scaling, may have no triangles
  BodyDescription description;
};

struct ModelAndState {
  Model model;
  State state;
};

/// Return bodies and state with another body before the one with this index, or without that one. The others stay as they are.
/// `gravity` is that of the world [m/s^2]. Throws Error as build_model does.
[[nodiscard]] ModelAndState with_body(const ModelAndState& bodies, std::size_t index, const BodySetup& setup,
                                      const glm::dvec3& gravity);
[[nodiscard]] ModelAndState without_body(const ModelAndState& bodies, std::size_t index);

/// Builds bodies from meshes: scale, stretch about the centroid, rotate about the mesh's origin, translate.
/// `gravity` is that of the world [m/s^2].
/// Throws Error (input) if
/// - there are more than 65,535 bodies,
/// - a mesh has no vertices,
/// - a mesh with pressure inside is open, not wound outward or flat, or is stretched to 1e-6 of its volume or inside out,
/// - the radius of a body with triangles is below 1e-6 m,
/// - a vertex stands beyond 1e9 m, moves faster than 1e9 m/s, or is not finite.
[[nodiscard]] ModelAndState build_model(std::span<const BodySetup> setups, const glm::dvec3& gravity,
                                        std::span<const GroundDescription> grounds = {});

}  // namespace pliant
