// Deformations under which forces by clusters are compared with those of all springs.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace pliant::bench {

struct Deformation {
  std::string name;
  std::vector<glm::dvec3> displacements;  // of all vertices
  bool is_crushed = false;                // parts that are far from each other at rest have come together
};

/// Returns positions about their mean, scaled so that the farthest is 1 away.
[[nodiscard]] std::vector<glm::dvec3> scaled_to_radius_1(std::span<const glm::dvec3> positions);

/// Returns displacements of about `size`, of a body that scaled_to_radius_1() has scaled, as in the deformation "smooth" below.
[[nodiscard]] std::vector<glm::dvec3> smooth_displacements_of(std::span<const glm::dvec3> rest, double size);

/// Returns all of them, of a body that scaled_to_radius_1() has scaled:
///
/// | name | what happens |
/// |---|---|
/// | smooth A | a smooth displacement of about A, from 1e-4 to 0.2 |
/// | turned | smooth 0.01, then a quarter turn about z |
/// | stretched | twice as long along x |
/// | dent | all below a fifth of the height is raised to there |
/// | dephased A | the smooth one times cos(2 pi r), where r is drawn anew for each vertex, scaled to a root mean square of A |
/// | flat | a tenth as high |
/// | poke | the middle of the upper half is lowered by up to 0.8 |
[[nodiscard]] std::vector<Deformation> deformations_of(std::span<const glm::dvec3> rest);

}  // namespace pliant::bench
