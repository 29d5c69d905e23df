// Leaves of clustered bodies in the vectors of every instruction set.
#include "device/cpu/leaf_springs.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <utility>
#include <vector>

namespace pliant::cpu {
namespace {

constexpr std::uint32_t leaf_count = 3, cluster_count = 9, place_count = leaf_count * leaf_lanes;

// How many vertices a node stands for.
constexpr double weight_of(std::uint32_t node) { return node == 0 ? 18 : 4.5; }

// Points of three leaves, the last vertex of which stands for nothing, and nodes of some clusters.
template <class Real>
std::vector<Real> random_points() {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Real> points;
  for (std::uint32_t p = 0; p < place_count + points_of_cluster * cluster_count; ++p) {
    const bool is_node = p >= place_count, is_padding = p == place_count - 1;
    for (int k = 0; k < 3; ++k) points.push_back(static_cast<Real>(coordinate(random)));
    points.push_back(static_cast<Real>(is_node ? weight_of((p - place_count) % points_of_cluster) : is_padding ? 0 : 1));
    for (int k = 0; k < 3; ++k) points.push_back(static_cast<Real>(0.1 * coordinate(random)));
    points.push_back(Real(0));
  }
  return points;
}

constexpr std::size_t node_of(std::uint32_t cluster, std::uint32_t node) {
  return place_count + std::size_t{points_of_cluster} * cluster + node;
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
glm::dvec3 vector_at(const std::vector<Real>& numbers, std::size_t at) {
  return {numbers[at], numbers[at + 1], numbers[at + 2]};
}

// Two clusters see others from far, the lower one in part by node 0 alone. What a leaf pulls stands apart from what others do.
template <class Real>
void check_leaf(const ClusterFunctions<Real>& functions, double rounding) {
  const std::vector<Real> points = random_points<Real>();
  const std::array<std::uint32_t, 2> near = {0, 2};
  constexpr std::uint32_t own = 2, own_leaf = 1;
  // [cluster][what its nodes' pulls begin with]
  const std::array<std::uint32_t, 10> below = {3, 6, 0, 18, 5, 36, 1, 72, 8, 108};
  const std::array<std::uint32_t, 4> above = {7, 144, 2, 180};
  const std::array<FarClusters, 2> seen = {FarClusters{.clusters = below.data(), .count = 5, .one_count = 2},
                                           FarClusters{.clusters = above.data(), .count = 2, .one_count = 0}};
  const std::array<std::uint32_t, 2> own_places = {own_leaf, own_leaf};
  std::vector<Real> pulls(3 * leaf_lanes), node_pulls(240, Real(-7));
  functions.sum_leaf({.points = points.data(),
                      .place_count = place_count,
                      .leaf = own,
                      .near_leaves = near.data(),
                      .near_count = near.size(),
                      .seen = seen.data(),
                      .own_places = own_places.data(),
                      .seen_count = seen.size(),
                      .pulls = pulls.data(),
                      .node_pulls = node_pulls.data()});
  std::vector<glm::dvec3> exact(leaf_lanes, glm::dvec3(0.0));
  for (std::uint32_t i = 0; i < leaf_lanes; ++i)
    for (const std::uint32_t leaf : near)
      for (std::uint32_t k = leaf * leaf_lanes; k < (leaf + 1) * leaf_lanes; ++k)
        exact[i] += static_cast<double>(points[point_size * k + 3]) * pull_of(points, own * leaf_lanes + i, k);
  std::size_t written = 0;
  for (const FarClusters& far : seen)
    for (std::uint32_t p = 0; p < far.count; ++p) {
      const bool is_one = p < far.one_count;
      for (std::uint32_t n = is_one ? 0 : 1; n < (is_one ? 1 : points_of_cluster); ++n) {
        const std::size_t node = node_of(far.clusters[2 * p], n);
        glm::dvec3 back(0.0);
        for (std::uint32_t i = 0; i < leaf_lanes; ++i) {
          const glm::dvec3 pull = pull_of(points, own * leaf_lanes + i, node);
          exact[i] += weight_of(n) * pull;
          if (i + 1 < leaf_lanes) back += pull;
        }
        const std::size_t at = far.clusters[2 * p + 1] + (is_one ? 3 * own_leaf : pull_row * own_leaf + 3 * (n - 1));
        CHECK(glm::distance(back, vector_at(node_pulls, at)) < rounding);
        written += 3;
      }
    }
  for (std::uint32_t i = 0; i < leaf_lanes; ++i) CHECK(glm::distance(exact[i], vector_at(pulls, 3 * i)) < 10 * rounding);
  CHECK(std::ranges::count(node_pulls, Real(-7)) == static_cast<std::ptrdiff_t>(node_pulls.size() - written));
}

// Of a cluster's nodes. The first rows of pulls are of node 0, four leaves in each.
template <class Real>
void check_nodes(const ClusterFunctions<Real>& functions, std::uint32_t one_count, std::uint32_t four_count, double rounding) {
  const std::vector<Real> points = random_points<Real>();
  constexpr std::uint32_t own = 4;
  std::vector<std::uint32_t> far;
  for (std::uint32_t p = 0; p < one_count + four_count; ++p) far.insert(far.end(), {(own + 1 + p) % cluster_count, 0});
  const std::uint32_t one_rows = one_count, rows = one_count + 2 * four_count;
  const std::uint32_t on_one = std::max(4 * one_rows, 2u) - 2;  // so that the last row of these lacks two
  std::vector<Real> node_pulls;
  for (std::uint32_t k = 0; k < pull_row * rows; ++k)
    node_pulls.push_back(k >= 3 * on_one && k < pull_row * one_rows ? std::numeric_limits<Real>::quiet_NaN()
                                                                    : static_cast<Real>(std::cos(k)));
  std::vector<Real> sums(3 * points_of_cluster, Real(-7));
  functions.sum_nodes({.points = points.data(),
                       .place_count = place_count,
                       .cluster = own,
                       .far = {.clusters = far.data(), .count = one_count + four_count, .one_count = one_count},
                       .node_pulls = node_pulls.data(),
                       .leaf_pulls_on_one = on_one,
                       .row_count = rows,
                       .sums = sums.data()});
  std::array<glm::dvec3, points_of_cluster> exact{};
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t k = 0; k < 4; ++k)
      if (row >= one_rows || 4 * row + k < on_one)
        exact[row < one_rows ? 0 : 1 + k] += vector_at(node_pulls, pull_row * row + 3 * k);
  for (std::uint32_t p = 0; p < one_count + four_count; ++p) {
    const std::uint32_t first = p < one_count ? 0 : 1, end = p < one_count ? 1 : points_of_cluster;
    for (std::uint32_t a = first; a < end; ++a)
      for (std::uint32_t b = first; b < end; ++b)
        exact[a] += weight_of(b) * pull_of(points, node_of(own, a), node_of(far[2 * p], b));
  }
  for (std::uint32_t n = 0; n < points_of_cluster; ++n) CHECK(glm::distance(exact[n], vector_at(sums, 3 * n)) < 10 * rounding);
}

template <class Real>
void check_clusters(Isa isa, double rounding) {
  CAPTURE(static_cast<int>(isa), sizeof(Real));
  const ClusterFunctions<Real> functions = cluster_functions<Real>(isa);
  check_leaf(functions, rounding);
  for (const auto& [ones, fours] : {std::pair(0u, 1u), {1u, 0u}, {5u, 3u}, {3u, 5u}, {8u, 0u}})
    check_nodes(functions, ones, fours, rounding);
}

TEST_CASE("leaves and nodes of clustered bodies are summed alike by every instruction set") {
  for (const Isa isa : available_isas()) {
    check_clusters<float>(isa, 1e-5);
    check_clusters<double>(isa, 1e-13);
  }
}

}  // namespace
}  // namespace pliant::cpu
