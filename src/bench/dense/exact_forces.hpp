// Forces of all springs on some vertices, which forces by clusters are compared with.
#pragma once
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"

namespace pliant::bench {

class ExactForces {
 public:
  /// Takes so many vertices, evenly spaced in the list. Positions and displacements are in any unit.
  ExactForces(ThreadPool& pool, std::span<const glm::dvec3> rest, std::span<const glm::dvec3> displacements, std::size_t samples);

  /// Returns the error of other forces on these vertices, over the size of the exact ones. `force_on` returns that on a vertex,
  /// over the stiffness, in the same unit.
  [[nodiscard]] double error_of(const std::function<glm::dvec3(std::size_t vertex)>& force_on) const;

 private:
  [[nodiscard]] std::size_t vertex_of(std::size_t sample) const { return sample * vertex_count_ / forces_.size(); }

  std::size_t vertex_count_;
  std::vector<glm::dvec3> forces_;  // of samples
};

}  // namespace pliant::bench
