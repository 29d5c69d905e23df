#include "bench/dense/exact_forces.hpp"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace pliant::bench {
namespace {

glm::dvec3 force_on(std::span<const glm::dvec3> rest, std::span<const glm::dvec3> displacements, std::size_t i) {
  glm::dvec3 sum(0.0);
  for (std::size_t j = 0; j < rest.size(); ++j) {
    if (j == i) continue;
    const glm::dvec3 before = rest[i] - rest[j], change = displacements[i] - displacements[j], x = before + change;
    const double length = glm::length(x), rest_length = glm::length(before);
    if (length <= 1e-12 * rest_length) continue;  // vertices in one place, but for rounding, pull each other in no direction
    sum -= glm::dot(change, before + x) / (length * (length + rest_length)) * x;
  }
  return sum;
}

}  // namespace

ExactForces::ExactForces(ThreadPool& pool, std::span<const glm::dvec3> rest, std::span<const glm::dvec3> displacements,
                         std::size_t samples)
    : vertex_count_(rest.size()), forces_(samples) {
  pool.for_ranges(static_cast<std::uint32_t>(samples), 4, [&](std::uint32_t first, std::uint32_t end) {
    for (; first < end; ++first) forces_[first] = force_on(rest, displacements, vertex_of(first));
  });
}

double ExactForces::error_of(const std::function<glm::dvec3(std::size_t)>& other_force_on) const {
  double error = 0, size = 0;
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const glm::dvec3 off = other_force_on(vertex_of(k)) - forces_[k];
    error += glm::dot(off, off);
    size += glm::dot(forces_[k], forces_[k]);
  }
  return std::sqrt(error / size);
}

}  // namespace pliant::bench
