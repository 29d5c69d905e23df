// Bodies whose springs are summed by clusters, in deformations of the suite `dense`.
#pragma once
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/dense/deformations.hpp"
#include "mesh/generators.hpp"
#include "support/evolve.hpp"
#include "support/impulse_scene.hpp"

namespace pliant {

constexpr double allowed_error = 1e-3;

inline const CollisionDescription no_contacts = {.response = {"none"}};

inline ModelAndState sphere_of(int level, const std::vector<glm::dvec3>& displacements = {}) {
  ModelAndState start = build_model(std::vector{soft(generate_mesh("icosphere:" + std::to_string(level)), "sphere")}, {0, 0, 0});
  for (std::uint32_t i = 0; i < displacements.size(); ++i)
    for (int k = 0; k < 3; ++k)
      start.state.motion[physics::displacement_of(i) + static_cast<std::size_t>(k)] = displacements[i][k];
  return start;
}

inline std::vector<glm::dvec3> rest_of(const Model& model) {
  std::vector<glm::dvec3> rest;
  for (std::uint32_t i = 0; i < model.vertex_count(); ++i) rest.push_back(model.rest_position(i));
  return rest;
}

// A sphere of radius 1 in one of the deformations of the suite `dense`.
inline ModelAndState deformed_sphere(int level, std::string_view name) {
  const ModelAndState sphere = sphere_of(level);
  for (const bench::Deformation& deformation : bench::deformations_of(rest_of(sphere.model)))
    if (deformation.name == name) return sphere_of(level, deformation.displacements);
  throw std::logic_error("no such deformation");
}

inline ModelAndState clustered(ModelAndState start, std::size_t body = 0) {
  start.model.bodies[body].forces = ForceSum::clustered;
  start.model.bodies[body].force_tolerance = allowed_error;
  start.model.bodies[body].is_clustered = true;
  return start;
}

inline std::vector<glm::dvec3> displacements_of(const State& state) {
  std::vector<glm::dvec3> displacements;
  for (std::uint32_t i = 0; i < state.motion.size() / physics::motion_size; ++i) displacements.push_back(state.displacement(i));
  return displacements;
}

inline double size_of(const std::vector<glm::dvec3>& vectors) {
  return distance(vectors, std::vector(vectors.size(), glm::dvec3(0.0)));
}

}  // namespace pliant
