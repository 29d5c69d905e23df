// Sums the springs of a clustered body's leaves and nodes, once for each instruction set. Files that include this header are
// compiled for different processors. So it holds only declarations: a linker could take an inline function from the wrong file.
#pragma once
#include <cstdint>

#include "device/cpu/isa.hpp"

namespace pliant::cpu {

// As physics/forces/clusters.glsl has them. Points have point_size numbers: place, how many vertices it stands for, displacement,
// 0.
inline constexpr unsigned leaf_lanes = 16, point_size = 8, points_of_cluster = 5, pull_row = 12;

/// Clusters that a cluster sees from far. Of the first ones it sees node 0, of the others nodes 1 to 4.
struct FarClusters {
  const std::uint32_t*
      clusters;  // [count][2]: a cluster, and where the leaves of the one that sees it keep what they pull it with
  std::uint32_t count, one_count;
};

template <class Real>
struct LeafSprings {
  const Real* points;
  std::uint32_t place_count;         // points before the first node
  std::uint32_t leaf;                // whose vertices these are
  const std::uint32_t* near_leaves;  // whose vertices they see
  std::uint32_t near_count;
  const FarClusters* seen;          // by the leaf and by clusters above
  const std::uint32_t* own_places;  // of the leaf among those of each of these
  std::uint32_t seen_count;
  Real* pulls;       // out: [vertex][3]
  Real* node_pulls;  // out: three numbers for each node, from where FarClusters says
};

template <class Real>
struct NodeSprings {
  const Real* points;
  std::uint32_t place_count;
  std::uint32_t cluster;  // whose nodes these are
  FarClusters far;
  const Real* node_pulls;           // [row][pull_row] of this cluster
  std::uint32_t leaf_pulls_on_one;  // on node 0, which come first, four in a row
  std::uint32_t row_count;          // of all nodes
  Real* sums;                       // out: [node][3]
};

/// `sum_leaf` gives the vertices of a leaf one lane each. `sum_nodes` has a pair of nodes in each lane.
template <class Real>
struct ClusterFunctions {
  void (*sum_leaf)(const LeafSprings<Real>&);
  void (*sum_nodes)(const NodeSprings<Real>&);
};

/// Returns the functions of an instruction set that is available.
template <class Real>
[[nodiscard]] ClusterFunctions<Real> cluster_functions(Isa isa);

template <class Real>
ClusterFunctions<Real> cluster_functions_portable();
template <class Real>
ClusterFunctions<Real> cluster_functions_avx2();
template <class Real>
ClusterFunctions<Real> cluster_functions_avx512();

}  // namespace pliant::cpu
