// Oracles for bodies that must not touch: proofs in fp64 with bounds on rounding, without the simulation's own search and tests.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace pliant::bench {

class ApartOracle {
 public:
  /// `model` must outlive the oracle.
  explicit ApartOracle(const Model& model);

  /// Returns how many pairs of triangles of different bodies are not proven to be apart. The proof is an axis on which the
  /// triangles' shadows are further apart than rounding accounts for. `positions` are those of the model's vertices in the world
  /// [m].
  [[nodiscard]] std::size_t pairs_not_apart(std::span<const glm::dvec3> positions) const;

  /// Returns how many vertices are inside another body whose mesh is closed. It sums solid angles.
  [[nodiscard]] std::size_t vertices_inside_others(std::span<const glm::dvec3> positions) const;

  /// Returns whether the boxes of all bodies are apart.
  [[nodiscard]] bool have_parted(std::span<const glm::dvec3> positions) const;

 private:
  const Model& model_;
  std::vector<bool> is_closed_;  // of each body
};

/// Returns positions on the straight way from `from` to `to`, after the part `part` of it.
[[nodiscard]] std::vector<glm::dvec3> between(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to, double part);

}  // namespace pliant::bench
