// A cluster is halved across its longest principal axis.
#include "dynamics/clusters/cluster_tree.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/expect.hpp"
#include "core/thread_pool.hpp"

namespace pliant {
namespace {

template <class PositionOf>
Extent extent_of(std::size_t count, const PositionOf& position_of) {
  Extent extent;
  for (std::size_t k = 0; k < count; ++k) extent.centre += position_of(k);
  extent.centre /= static_cast<double>(count);
  double radius_squared = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const glm::dvec3 arm = position_of(k) - extent.centre;
    const double squared = glm::dot(arm, arm);
    radius_squared = std::max(radius_squared, squared);
    extent.spread_squared += squared;
  }
  extent.radius = std::sqrt(radius_squared);
  extent.spread_squared /= static_cast<double>(count);
  return extent;
}

class Builder {
 public:
  explicit Builder(std::span<const glm::dvec3> rest) : rest_(rest), keys_(rest.size()) {
    tree_.order.resize(rest.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0u);
    tree_.clusters.push_back({.first = 0, .end = static_cast<std::uint32_t>(rest.size())});
    tree_.leaves.resize(tree_.clusters[0].end_leaf());
    for (std::uint32_t c = 0; c < tree_.clusters.size(); ++c) serve(c);
  }

  ClusterTree take() { return std::move(tree_); }

 private:
  void serve(std::uint32_t c) {
    Cluster cluster = tree_.clusters[c];
    const std::span<std::uint32_t> vertices(tree_.order.data() + cluster.first, cluster.size());
    cluster.rest = extent_of(vertices.size(), [&](std::size_t k) { return rest_[vertices[k]]; });
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread = spread_of(cluster, vertices);
    set_axes(cluster, spread);
    if (cluster.size() > leaf_size) {
      cluster.first_child = static_cast<std::uint32_t>(tree_.clusters.size());
      const std::uint32_t middle = cluster.first + size_of_left(cluster.size());
      split(vertices, middle - cluster.first, direction_of(spread, 2));
      tree_.clusters.push_back({.first = cluster.first, .end = middle, .parent = c});
      tree_.clusters.push_back({.first = middle, .end = cluster.end, .parent = c});
    } else {
      tree_.leaves[cluster.first_leaf()] = c;
    }
    tree_.clusters[c] = cluster;
  }

  // About half, and whole leaves.
  static std::uint32_t size_of_left(std::uint32_t size) {
    const std::uint32_t leaves = (size + leaf_size - 1) / leaf_size;
    return leaves / 2 * leaf_size;
  }

  // Returns mean squares along principal axes, of which the longest is the last.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread_of(const Cluster& cluster,
                                                           std::span<const std::uint32_t> vertices) const {
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    for (const std::uint32_t v : vertices) {
      const glm::dvec3 arm = rest_[v] - cluster.rest.centre;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j) moment(i, j) += arm[i] * arm[j];
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment / static_cast<double>(vertices.size()));
  }

  static glm::dvec3 direction_of(const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>& spread, int axis) {
    const Eigen::Vector3d direction = spread.eigenvectors().col(axis);
    return {direction[0], direction[1], direction[2]};
  }

  // An axis across which the cluster is flat is left out.
  static void set_axes(Cluster& cluster, const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>& spread) {
    for (int m = 0; m < 3; ++m) {
      const double length = std::sqrt(std::max(spread.eigenvalues()[m], 0.0));
      if (length <= 1e-3 * cluster.rest.radius) continue;
      cluster.slopes[m] = direction_of(spread, m) / length;
      cluster.squares[m] = length * length;
    }
  }

  // Puts the vertices that are lowest along the axis first.
  void split(std::span<std::uint32_t> vertices, std::uint32_t count, const glm::dvec3& axis) {
    for (const std::uint32_t v : vertices) keys_[v] = glm::dot(rest_[v], axis);
    std::nth_element(vertices.begin(), vertices.begin() + count, vertices.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return keys_[a] < keys_[b] || (keys_[a] == keys_[b] && a < b); });
    std::sort(vertices.begin(), vertices.begin() + count);
    std::sort(vertices.begin() + count, vertices.end());
  }

  std::span<const glm::dvec3> rest_;
  std::vector<double> keys_;
  ClusterTree tree_;
};

}  // namespace

glm::dvec3 Cluster::offset_of(std::uint32_t node) const {
  glm::dvec3 offset(0.0);
  for (int m = 0; node > 0 && m < 3; ++m)
    offset += physics::side_of_node(node, static_cast<std::uint32_t>(m)) * squares[m] * slopes[m];
  return offset;
}

glm::dvec3 Cluster::gradient_of(std::uint32_t node) const {
  glm::dvec3 gradient(0.0);
  for (int m = 0; node > 0 && m < 3; ++m) gradient += physics::side_of_node(node, static_cast<std::uint32_t>(m)) * slopes[m];
  return gradient;
}

std::vector<Extent> extents_moved_by(ThreadPool& pool, const ClusterTree& tree, std::span<const glm::dvec3> rest,
                                     std::span<const glm::dvec3> displacements) {
  if (displacements.empty()) return {};
  PLIANT_EXPECT(displacements.size() == rest.size() && rest.size() == tree.order.size());
  std::vector<glm::dvec3> positions;  // in the tree's order
  positions.reserve(rest.size());
  for (const std::uint32_t v : tree.order) positions.push_back(rest[v] + displacements[v]);
  std::vector<Extent> extents(tree.clusters.size());
  pool.for_ranges(static_cast<std::uint32_t>(extents.size()), 8, [&](std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t c = first; c < end; ++c)
      extents[c] = extent_of(tree.clusters[c].size(), [&](std::size_t k) { return positions[tree.clusters[c].first + k]; });
  });
  return extents;
}

ClusterTree make_cluster_tree(std::span<const glm::dvec3> rest) {
  PLIANT_EXPECT(!rest.empty());
  return Builder(rest).take();
}

}  // namespace pliant
