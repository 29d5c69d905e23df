#include "bench/dense/deformations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace pliant::bench {
namespace {

// Each component is the mean of eight waves.
class SmoothField {
 public:
  SmoothField() {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (auto& component : waves_)
      for (Wave& wave : component) {
        wave.size = normal(random);
        for (int k = 0; k < 3; ++k) wave.number[k] = normal(random);
        wave.phase = normal(random);
      }
  }

  glm::dvec3 operator()(const glm::dvec3& p) const {
    glm::dvec3 sum(0.0);
    for (int k = 0; k < 3; ++k)
      for (const Wave& wave : waves_[k]) sum[k] += wave.size * std::sin(1.3 * glm::dot(wave.number, p) + 3 * wave.phase) / 8;
    return sum;
  }

 private:
  struct Wave {
    double size, phase;
    glm::dvec3 number;
  };
  Wave waves_[3][8];
};

// Scales them so that the mean of their squares is that of `size`.
void scale_to(double size, std::vector<glm::dvec3>& displacements) {
  double sum = 0;
  for (const glm::dvec3& u : displacements) sum += glm::dot(u, u);
  for (glm::dvec3& u : displacements) u *= size / std::sqrt(sum / static_cast<double>(displacements.size()));
}

}  // namespace

std::vector<glm::dvec3> scaled_to_radius_1(std::span<const glm::dvec3> positions) {
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& p : positions) mean += p / static_cast<double>(positions.size());
  double radius = 0;
  for (const glm::dvec3& p : positions) radius = std::max(radius, glm::length(p - mean));
  std::vector<glm::dvec3> scaled;
  for (const glm::dvec3& p : positions) scaled.push_back((p - mean) / radius);
  return scaled;
}

std::vector<glm::dvec3> smooth_displacements_of(std::span<const glm::dvec3> rest, double size) {
  const SmoothField smooth;
  std::vector<glm::dvec3> displacements;
  for (const glm::dvec3& p : rest) displacements.push_back(size * smooth(p));
  return displacements;
}

std::vector<Deformation> deformations_of(std::span<const glm::dvec3> rest) {
  const SmoothField smooth;
  std::vector<Deformation> all;
  const auto add = [&](std::string name, const std::function<glm::dvec3(const glm::dvec3&)>& displacement,
                       bool is_crushed = false) {
    Deformation& deformation = all.emplace_back(Deformation{std::move(name), {}, is_crushed});
    for (const glm::dvec3& p : rest) deformation.displacements.push_back(displacement(p));
  };
  for (const double size : {1e-4, 1e-2, 0.2})
    add(fmt::format("smooth {}", size), [&](const glm::dvec3& p) { return size * smooth(p); });
  add("turned", [&](const glm::dvec3& p) {
    const glm::dvec3 moved = p + 1e-2 * smooth(p);
    return glm::dvec3(-moved.y, moved.x, moved.z) - p;
  });
  add("stretched", [](const glm::dvec3& p) { return glm::dvec3(p.x, 0, 0); });
  const auto [lowest, highest] = std::ranges::minmax(rest, {}, [](const glm::dvec3& p) { return p.z; });
  const double level = lowest.z + 0.2 * (highest.z - lowest.z);
  add("dent", [&](const glm::dvec3& p) { return glm::dvec3(0, 0, std::max(level - p.z, 0.0)); });
  std::mt19937 random(2);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
  for (const double size : {0.003, 0.008, 0.03}) {
    add(fmt::format("dephased {}", size), [&](const glm::dvec3& p) { return std::cos(turn(random)) * smooth(p); });
    scale_to(size, all.back().displacements);
  }
  add(
      "flat", [](const glm::dvec3& p) { return glm::dvec3(0, 0, -0.9 * p.z); }, true);
  add(
      "poke",
      [](const glm::dvec3& p) { return glm::dvec3(0, 0, p.z > 0 ? -0.8 * std::exp(-20 * (p.x * p.x + p.y * p.y)) : 0.0); }, true);
  return all;
}

}  // namespace pliant::bench
