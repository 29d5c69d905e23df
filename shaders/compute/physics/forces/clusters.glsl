// Springs of a clustered body. Its vertices stand in the order of a tree, leaf_size of them in a leaf. Clusters that are far from each
// other see each other's nodes in place of each other's vertices. src/dynamics/clusters/cluster_pairs.hpp has the formula.
//
// What pulls a point is here a sum of strain times length over its springs, in the body's unit. It is minus the force over the stiffness.
#ifndef CLUSTERS_GLSL
#define CLUSTERS_GLSL
#include "../language.glsl"
SHARED_BEGIN

const uint leaf_size = 16u;          // vertices, as many as the widest vectors have lanes
const uint nodes_of_cluster = 5u;    // the first one can stand for all vertices, the other four together
const uint no_cluster = 0xffffffffu;

struct SpringCluster {
  double centre[3];     // of its vertices at rest [m]
  double offset[12];    // of nodes 1 to 4, from there [m]
  double gradient[12];  // a node moves as the mean of (1 + gradient . (X - centre)) u over the vertices [1/m]
  uint body_index;
  uint parent;          // no_cluster above the root
  uint first_leaf;
  uint end_leaf;
  uint first_far;       // in `far_node`: nodes that its vertices see
  uint end_far;
  uint first_partner;   // in `far_cluster`: whose nodes these are
  uint end_partner;
  uint first_node_pull; // of its leaves, in `node_pull`, counted in three numbers
  uint vertex_count;
};

// Of the nodes that stand for a cluster, which are one or four.
FN uint first_node(uint nodes) { return nodes == 1u ? 0u : 1u; }

// `spring_point` has two vectors a point: its place and how many vertices it stands for, then its displacement. Points are places in
// trees, then nodes.
FN uint place_of_point(uint point) { return 2u * point; }
FN uint displacement_of_point(uint point) { return 2u * point + 1u; }
FN uint point_of_node(uint place_count, uint cluster, uint node) { return place_count + nodes_of_cluster * cluster + node; }

// `leaf_moment` has 12 numbers a leaf: the sum of u [body's unit], then those of X.x u, X.y u and X.z u, with X from the leaf's centre
// [unit squared]. `cluster_pull` has as many: what every vertex of the cluster gets [unit], then what it gets for X.x, X.y and X.z, with
// X from the cluster's centre [1].
const uint moments_size = 12u;
const uint pulls_size = 15u;  // of all nodes of a cluster

// `node_pull` has three numbers for each node that a leaf sees. Those of one node stand one leaf after another.
FN uint node_pull_of(uint first, uint node, uint leaf_count, uint leaf) { return 3u * (first + node * leaf_count + leaf); }

SHARED_END
#endif
