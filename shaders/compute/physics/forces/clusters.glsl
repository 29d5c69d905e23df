// Springs of a clustered body. Its vertices stand in the order of a tree, leaf_size of them in a leaf. Clusters that are far from each
// other see each other's nodes in place of each other's vertices. src/dynamics/clusters/cluster_pairs.hpp has the formula.
//
// What pulls a point is here a sum of strain times length over its springs, in the body's unit. It is minus the force over the stiffness.
#ifndef CLUSTERS_GLSL
#define CLUSTERS_GLSL
#include "../language.glsl"
SHARED_BEGIN

const uint leaf_size = 16u;          // vertices, as many as the widest vectors have lanes
const uint leaves_of_tile = 4u;      // which one group serves where there is little to do for each
const uint places_of_tile = leaves_of_tile * leaf_size;
const uint nodes_of_cluster = 5u;    // the first one can stand for all vertices, the other four together
const uint most_samples = 256u;       // vertices of a body whose springs are all summed now and then
const uint parts_of_sample = 8u;      // a leaf of them comes so often, each time with a part of the body's leaves near it
const uint most_above = 40u;         // clusters that hold a leaf, in a tree of 2^32 vertices, and more

struct SpringCluster {
  double centre[3];      // of its vertices at rest [m]
  double slope[9];       // three principal axes, over the vertices' spread along them, or 0 if that is tiny [1/m]
  double squares[3];     // the squares of those spreads [m^2]
  uint body_index;
  uint vertex_count;
  uint first_leaf;
  uint end_leaf;
  uint first_far;        // in `far_cluster`: clusters whose node 0 it sees
  uint first_far_four;   // and those of which it sees nodes 1 to 4
  uint end_far;
  uint first_pull;       // in rows of `node_pull`: what pulls its node 0
  uint leaf_pulls_on_one;  // which come first, four in a row. The last row may lack some. Rows of nodes 1 to 4 follow
  uint end_pull;
};

// `spring_point` has two vectors a point: its place and how many vertices it stands for, then its displacement. Points are places in
// trees, then nodes.
FN uint place_of_point(uint point) { return 2u * point; }
FN uint displacement_of_point(uint point) { return 2u * point + 1u; }
FN uint point_of_node(uint place_count, uint cluster, uint node) { return place_count + nodes_of_cluster * cluster + node; }

// `leaf_moment` has 12 numbers a leaf: the sum of u [body's unit], then those of X.x u, X.y u and X.z u [unit squared]. `cluster_pull` has
// as many: what every vertex of the cluster gets [unit], then what it gets for X.x, X.y and X.z [1]. X is a vertex's place at rest.
const uint moments_size = 12u;
const uint pulls_size = 15u;  // of all nodes of a cluster

// Nodes 1 to 4 are corners of a box about the centre that is as wide as the vertices' spread. A node moves as the mean
// of (1 + gradient . (X - centre)) u over the vertices. Returns on which side of an axis one is.
FN double side_of_node(uint node, uint axis) { return node == 1u || node == axis + 2u ? double(1) : double(-1); }
// Of the nodes that stand for a cluster, which are one or four.
FN uint first_node(uint nodes) { return nodes == 1u ? 0u : 1u; }

// `node_pull` has rows of 12 numbers: what a leaf pulls the four nodes of a cluster with, or what four leaves pull its node 0 with.
const uint pull_row_size = 12u;
FN uint leaf_of_pull(uint nodes) { return nodes == 1u ? 3u : pull_row_size; }  // numbers from one leaf's to the next leaf's

FN uint rows_of_one(uint leaf_pulls) { return (leaf_pulls + 3u) / 4u; }

// Memory that a group has in common stands in banks. [number][thread] with so many numbers from one row to the next meets all of them.
const uint bank_row = 65u;
const uint bank_moments = moments_size + 1u;

SHARED_END
#endif
