// A tree of clusters over the vertices of a body at rest. Clusters that are far from each other act through few points, their
// nodes (cluster_pairs.hpp).
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "physics/forces/clusters.glsl"

namespace pliant {

class ThreadPool;
using physics::leaf_size;

/// Where vertices stand, and how far from each other.
struct Extent {
  glm::dvec3 centre{0.0};     // their mean [m]
  double radius = 0;          // from there to the farthest one [m]
  double spread_squared = 0;  // mean square of the distances from there [m^2]
};

/// Vertices that follow each other in a tree's order. They begin where a leaf begins. Nodes stand for them: points which each
/// move as the mean of (1 + gradient . (X - centre)) u over all of them. So nodes move with them in all linear motions. If the
/// cluster is flat or thin, they do so in those within its plane or line.
struct Cluster {
  std::uint32_t first = 0, end = 0;
  std::uint32_t parent = 0;       // the root is its own
  std::uint32_t first_child = 0;  // the other one follows. 0: it is a leaf
  Extent rest{};                  // of its vertices at rest
  glm::dmat3 slopes{0.0};         // principal axes, over the vertices' spread along them, or 0 if that is tiny [1/m]
  glm::dvec3 squares{0.0};        // the squares of those spreads [m^2]

  [[nodiscard]] bool is_leaf() const { return first_child == 0; }
  [[nodiscard]] std::uint32_t size() const { return end - first; }
  [[nodiscard]] std::uint32_t first_leaf() const { return first / leaf_size; }
  [[nodiscard]] std::uint32_t end_leaf() const { return (end + leaf_size - 1) / leaf_size; }

  /// Returns where a node is from the centre at rest [m]. Node 0 is the centre, which can stand for all vertices. Nodes 1 to 4
  /// can together.
  [[nodiscard]] glm::dvec3 offset_of(std::uint32_t node) const;
  /// Returns the gradient by which it moves, as above [1/m].
  [[nodiscard]] glm::dvec3 gradient_of(std::uint32_t node) const;
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
[[nodiscard]] std::vector<Extent> extents_moved_by(ThreadPool& pool, const ClusterTree& tree, std::span<const glm::dvec3> rest,
                                                   std::span<const glm::dvec3> displacements);

}  // namespace pliant
