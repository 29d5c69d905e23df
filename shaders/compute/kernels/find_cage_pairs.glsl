// One thread takes some pairs of subtrees, one of either tree of two near bodies. It lists pairs of leaves whose boxes of cages overlap.
// If the list is full, it lists the pairs of their triangles itself.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/surface.glsl"
WRITE(control)
READ(near_pair)
WRITE(leaf_pair)
PARAMETER(uint, leaf_pair_capacity)
PARAMETER(uint, node_count)  // of all trees
PARAMETER(uint, threads_of_a_pair)
PARAMETER(uint, pairs_at_once)  // threads go on to later pairs in strides of this
#include "parts/list_triangles.glsl"

void found_leaves(uvec2 leaves) {
  uint at = atomicAdd(control[0].leaf_pair_count, 1u);  // alone: threads come here one by one
  if (at < leaf_pair_capacity)
    leaf_pair[at] = leaves;
  else
    list_triangles(leaves, 0u, 1u);
}

#include "parts/descend.glsl"

void find_cage_pairs(uint item) { descend_trees(item); }
