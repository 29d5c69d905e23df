// Which clusters of a body act on each other vertex by vertex, and which through their nodes.
//
// The springs between two clusters A and B that are far from each other have an energy near to
//   sum over i in A and nodes b of w_b phi(i, b) + sum over nodes a and j in B of w_a phi(a, j) - sum over a and b of w_a w_b
//   phi(a, b).
// phi(p, q) = (|x| - L)^2 / 2 is a spring's energy. A node stands for w vertices, which are those of its cluster over the number
// of nodes. So each side sees all vertices of the other's through its nodes, and what is counted twice is taken off. Forces are
// the exact gradient of that energy, so that they add up to no force and no torque. Nodes move as means of their vertices.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "dynamics/clusters/cluster_tree.hpp"

namespace pliant {

/// A cluster that is seen through its nodes.
struct FarCluster {
  std::uint32_t cluster;
  std::uint32_t nodes;  // 1: node 0. 4: nodes 1 to 4
};

/// The pairs cover each pair of vertices once. Both sides of a pair list each other.
struct ClusterPairs {
  std::vector<std::uint32_t> near_begin;  // [leaf + 1] where a leaf's part of `near` begins
  std::vector<std::uint32_t> near;        // leaves whose vertices it sees one by one, itself among them, in ascending order
  std::vector<std::uint32_t> far_begin;   // [cluster + 1] where a cluster's part of `far` begins
  std::vector<FarCluster> far;            // in the order of a walk by one thread
};

/// How many springs stand for those between all pairs of vertices.
struct SpringCounts {
  std::uint64_t near = 0;           // between two vertices
  std::uint64_t far = 0;            // between a vertex and a node
  std::uint64_t between_nodes = 0;  // which take off what counts twice
  [[nodiscard]] std::uint64_t all() const { return near + far + between_nodes; }
};

/// The most entries that both lists of a body have together. A device keeps 4 bytes or more for each.
inline constexpr std::uint64_t most_list_entries = 1u << 28;

/// A smaller `accuracy` (tau) makes more pairs near. Expects it to be positive. With `shape`, clusters are far from each other
/// only if they are in that shape, too. It has the extent of each cluster there. Throws Error (input) if so many vertices are
/// near each other that both lists would have more than `most_entries`, and std::bad_alloc if memory runs out before.
[[nodiscard]] ClusterPairs pair_clusters(ThreadPool& pool, const ClusterTree& tree, double accuracy,
                                         std::span<const Extent> shape = {}, std::uint64_t most_entries = most_list_entries);

[[nodiscard]] SpringCounts count_springs(const ClusterTree& tree, const ClusterPairs& pairs);

/// Returns the accuracy for forces with about this relative error. In smooth deformations it is a third of that. Where neighbours
/// move apart by 0.01 of the body's radius it is as much for tolerances from 1e-3 on, and more for smaller ones. Rougher
/// deformations have an error that no accuracy takes away.
[[nodiscard]] double accuracy_of(double tolerance);

}  // namespace pliant
