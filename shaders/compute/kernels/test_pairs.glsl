// One thread tests a sixteenth of the pairs of triangles of two leaves. All threads share the list of leaf pairs in strides. If the list was
// too short, they descend the trees once more, and test the pairs that they find.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
WRITE(control)
READ(near_pair)
READ(leaf_pair)
READ(node)
READ(node_box)
READ(triangle)
READ(world_position)
WRITE(mark)
PARAMETER(uint, first_position)
PARAMETER(uint, triangle_test)
PARAMETER(uint, leaf_pair_capacity)
PARAMETER(uint, pairs_at_once)
#include "parts/test_leaves.glsl"
void found_leaves(uvec2 leaves) { test_leaves(leaves, uvec2(0), 1u); }
#include "parts/descend.glsl"

void test_pairs(uint item) {
  uint count = control[0].leaf_pair_count, part = item % threads_per_leaf_pair;
  if (count > leaf_pair_capacity) {
    if (item == 0u) atomicAdd(control[0].count[pairs_beyond_capacity], count - leaf_pair_capacity);
    descend_trees(item, threads_per_leaf_pair * pairs_at_once);
    return;
  }
  for (uint k = item / threads_per_leaf_pair; k < count; k += pairs_at_once)
    test_leaves(leaf_pair[k], uvec2(part / 4u, part % 4u), 4u);
}
