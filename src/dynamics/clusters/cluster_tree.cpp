// A cluster is halved across its longest principal axis.
#include "dynamics/clusters/cluster_tree.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/expect.hpp"

namespace pliant {
namespace {

struct Axes {
  std::array<glm::dvec3, 3> direction;  // the longest last
  std::array<double, 3> spread;         // root of the mean square along them [m]
};

Extent extent_of(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> vertices) {
  Extent extent;
  for (const std::uint32_t v : vertices) extent.centre += positions[v];
  extent.centre /= static_cast<double>(vertices.size());
  for (const std::uint32_t v : vertices) {
    const glm::dvec3 arm = positions[v] - extent.centre;
    extent.radius = std::max(extent.radius, glm::length(arm));
    extent.spread_squared += glm::dot(arm, arm);
  }
  extent.spread_squared /= static_cast<double>(vertices.size());
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
    cluster.rest = extent_of(rest_, vertices);
    const Axes axes = axes_of(cluster, vertices);
    place_nodes(cluster, axes);
    if (cluster.size() > leaf_size) {
      cluster.first_child = static_cast<std::uint32_t>(tree_.clusters.size());
      const std::uint32_t middle = cluster.first + size_of_left(cluster.size());
      split(vertices, middle - cluster.first, axes.direction[2]);
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

  Axes axes_of(const Cluster& cluster, std::span<const std::uint32_t> vertices) const {
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    for (const std::uint32_t v : vertices) {
      const glm::dvec3 arm = rest_[v] - cluster.rest.centre;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j) moment(i, j) += arm[i] * arm[j];
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moment / static_cast<double>(vertices.size()));
    Axes axes;
    for (int m = 0; m < 3; ++m) {
      for (int k = 0; k < 3; ++k) axes.direction[m][k] = solver.eigenvectors()(k, m);
      axes.spread[m] = std::sqrt(std::max(solver.eigenvalues()[m], 0.0));
    }
    return axes;
  }

  // Four corners of a box that is as wide as the vertices' spread. An axis across which the cluster is flat is left out.
  static void place_nodes(Cluster& cluster, const Axes& axes) {
    constexpr int corners[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (int a = 0; a < 4; ++a)
      for (int m = 0; m < 3; ++m) {
        if (axes.spread[m] <= 1e-3 * cluster.rest.radius) continue;
        cluster.nodes[a + 1].offset += corners[a][m] * axes.spread[m] * axes.direction[m];
        cluster.nodes[a + 1].gradient += corners[a][m] / axes.spread[m] * axes.direction[m];
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

std::vector<Extent> extents_moved_by(const ClusterTree& tree, std::span<const glm::dvec3> rest,
                                     std::span<const glm::dvec3> displacements) {
  if (displacements.empty()) return {};
  PLIANT_EXPECT(displacements.size() == rest.size() && rest.size() == tree.order.size());
  std::vector<glm::dvec3> positions(rest.begin(), rest.end());
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += displacements[v];
  std::vector<Extent> extents;
  for (const Cluster& cluster : tree.clusters)
    extents.push_back(extent_of(positions, std::span(tree.order).subspan(cluster.first, cluster.size())));
  return extents;
}

ClusterTree make_cluster_tree(std::span<const glm::dvec3> rest) {
  PLIANT_EXPECT(!rest.empty());
  return Builder(rest).take();
}

}  // namespace pliant
