// Leaves of clustered bodies in the vectors of every instruction set.
#include "device/cpu/leaf_springs.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace pliant::cpu {
namespace {

constexpr std::uint32_t leaf_count = 3, node_count = 21;

// Points of three leaves, the last vertex of which stands for nothing, and of some nodes.
template <class Real>
std::vector<Real> random_points_of_leaves() {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Real> points;
  for (std::uint32_t p = 0; p < leaf_count * leaf_lanes + node_count; ++p) {
    const bool is_node = p >= leaf_count * leaf_lanes, is_padding = p == leaf_count * leaf_lanes - 1;
    for (int k = 0; k < 3; ++k) points.push_back(static_cast<Real>(coordinate(random)));
    points.push_back(is_node ? Real(4.5) : is_padding ? Real(0) : Real(1));
    for (int k = 0; k < 3; ++k) points.push_back(static_cast<Real>(0.1 * coordinate(random)));
    points.push_back(Real(0));
  }
  return points;
}

// What pulls point a towards b, or away.
template <class Real>
glm::dvec3 pull_of(const std::vector<Real>& points, std::size_t a, std::size_t b) {
  const auto vector = [&](std::size_t point, std::size_t first) {
    const Real* const at = points.data() + point_size * point + first;
    return glm::dvec3(at[0], at[1], at[2]);
  };
  const glm::dvec3 x = vector(a, 0) - vector(b, 0), change = vector(a, 4) - vector(b, 4);
  const double length = glm::length(x);
  return a == b ? glm::dvec3(0.0) : (length - glm::length(x - change)) / length * x;
}

template <class Real>
void check_leaf(LeafFunction<Real> function, double rounding) {
  const std::vector<Real> points = random_points_of_leaves<Real>();
  const std::array<std::uint32_t, 2> near = {0, 2};
  const std::uint32_t own = 2, first_node = leaf_count * leaf_lanes;
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t n = 0; n < node_count; ++n) nodes.push_back(first_node + (5 * n) % node_count);
  constexpr std::uint32_t stride = 6;
  std::vector<Real> back(stride * node_count, Real(-7)), pulls(3 * leaf_lanes);
  const std::array<SeenNodes<Real>, 2> seen = {
      SeenNodes<Real>{nodes.data(), 18, stride, back.data()},
      SeenNodes<Real>{nodes.data() + 18, node_count - 18, stride, back.data() + 18 * stride}};
  function({.points = points.data(),
            .leaf = own,
            .near_leaves = near.data(),
            .near_count = near.size(),
            .seen = seen.data(),
            .seen_count = seen.size(),
            .pulls = pulls.data()});
  for (std::uint32_t i = 0; i < leaf_lanes; ++i) {
    const std::size_t vertex = own * leaf_lanes + i;
    glm::dvec3 exact(0.0);
    for (const std::uint32_t leaf : near)
      for (std::uint32_t k = 0; k < leaf_lanes; ++k)
        exact += static_cast<double>(points[point_size * (leaf * leaf_lanes + k) + 3]) *
                 pull_of(points, vertex, leaf * leaf_lanes + k);
    for (const std::uint32_t node : nodes) exact += 4.5 * pull_of(points, vertex, node);
    CHECK(glm::distance(exact, glm::dvec3(pulls[3 * i], pulls[3 * i + 1], pulls[3 * i + 2])) < rounding);
  }
  for (std::uint32_t n = 0; n < node_count; ++n) {
    glm::dvec3 exact(0.0);
    for (std::uint32_t i = 0; i + 1 < leaf_lanes; ++i) exact += pull_of(points, own * leaf_lanes + i, nodes[n]);
    const Real* const at = back.data() + stride * n;
    CHECK(glm::distance(exact, glm::dvec3(at[0], at[1], at[2])) < rounding);
    for (std::uint32_t k = 3; k < stride; ++k) CHECK(at[k] == Real(-7));  // which is another leaf's
  }
}

TEST_CASE("leaves of clustered bodies are summed alike by every instruction set") {
  for (const Isa isa : available_isas()) {
    CAPTURE(static_cast<int>(isa));
    check_leaf<float>(leaf_function<float>(isa), 1e-5);
    check_leaf<double>(leaf_function<double>(isa), 1e-13);
  }
}

}  // namespace
}  // namespace pliant::cpu
