// A tree of clusters over the vertices of a body at rest. Clusters that are far from each other act through few points, their
// nodes (cluster_pairs.hpp).
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "physics/forces/clusters.glsl"

namespace pliant {

using physics::leaf_size;

/// A point that stands for vertices of a cluster. It moves as the mean of (1 + gradient . (X - centre)) u over all of them, so
/// that it moves with them in all linear motions. If the cluster is flat or thin, it does so in those within its plane or line.
struct ClusterNode {
  glm::dvec3 offset{0.0};    // from the cluster's centre at rest [m]
  glm::dvec3 gradient{0.0};  // [1/m]
};

/// Where vertices stand, and how far from each other.
struct Extent {
  glm::dvec3 centre{0.0};     // their mean [m]
  double radius = 0;          // from there to the farthest one [m]
  double spread_squared = 0;  // mean square of the distances from there [m^2]
};

/// Vertices that follow each other in a tree's order. They begin where a leaf begins.
struct Cluster {
  std::uint32_t first = 0, end = 0;
  std::uint32_t parent = 0;            // the root is its own
  std::uint32_t first_child = 0;       // the other one follows. 0: it is a leaf
  Extent rest{};                       // of its vertices at rest
  std::array<ClusterNode, 5> nodes{};  // the centre, which can stand for all vertices, then four which can together

  [[nodiscard]] bool is_leaf() const { return first_child == 0; }
  [[nodiscard]] std::uint32_t size() const { return end - first; }
  [[nodiscard]] std::uint32_t first_leaf() const { return first / leaf_size; }
  [[nodiscard]] std::uint32_t end_leaf() const { return (end + leaf_size - 1) / leaf_size; }
};

/// Leaf k has the places from k leaf_size on. All leaves but the last one are full.
struct ClusterTree {
  std::vector<std::uint32_t> order;   // vertices by their places in the tree
  std::vector<Cluster> clusters;      // the root first, each before its children
  std::vector<std::uint32_t> leaves;  // the clusters that are leaves, in the order of places
};

/// `rest` are positions at rest [m], at least one.
[[nodiscard]] ClusterTree make_cluster_tree(std::span<const glm::dvec3> rest);

/// Returns the extent of each cluster of the tree where its vertices are moved by these displacements [m]. Returns nothing if
/// there are none.
[[nodiscard]] std::vector<Extent> extents_moved_by(const ClusterTree& tree, std::span<const glm::dvec3> rest,
                                                   std::span<const glm::dvec3> displacements);

}  // namespace pliant
