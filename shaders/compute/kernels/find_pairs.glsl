// One thread takes some pairs of subtrees, one of either tree of two near bodies. It descends both together, down to pairs of leaves whose
// boxes overlap. It lists these pairs for test_pairs. If the list is full, it tests them itself. Many threads serve one pair of bodies.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
WRITE(control)
READ(near_pair)
READ(node)
READ(node_box)
READ(triangle)
READ(world_position)
WRITE(leaf_pair)
WRITE(mark)
PARAMETER(uint, first_position)
PARAMETER(uint, triangle_test)
PARAMETER(uint, leaf_pair_capacity)
PARAMETER(uint, node_count)  // of all trees
PARAMETER(uint, threads_of_a_pair)
PARAMETER(uint, pairs_at_once)  // threads go on to later pairs in strides of this
#include "parts/test_leaves.glsl"

void found_leaves(uvec2 leaves) {
  uint at = atomicAdd(control[0].leaf_pair_count, 1u);  // alone: threads come here one by one
  if (at < leaf_pair_capacity) {
    leaf_pair[at] = leaves;
  } else {
    atomicAdd(control[0].count[pairs_beyond_capacity], 1u);
    test_leaves(leaves, uvec2(0), 1u);
  }
}

#include "parts/descend.glsl"

void find_pairs(uint item) { descend_trees(item); }
