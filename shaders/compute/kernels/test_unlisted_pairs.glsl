// A group kernel. Where the list of leaf pairs was too short, it descends trees as find_pairs does, and tests the leaves that it finds.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
#include "../physics/collision/treelet.glsl"
WRITE(control)
READ(node)
READ(node_box)
READ(triangle)
READ(world_position)
WRITE(mark)
PARAMETER(uint, first_position)
PARAMETER(uint, triangle_test)
PARAMETER(uint, leaf_pair_capacity)
#include "parts/test_leaves.glsl"
void found_leaves(uvec2 leaves) { test_leaves(leaves, 0u, 1u); }
#include "parts/descend.glsl"

void test_unlisted_pairs(uint item) {
  if (control[0].leaf_pair_count <= leaf_pair_capacity) return;
  if (item == 0u && THREAD == 0u) atomicAdd(control[0].count[pairs_beyond_capacity], control[0].leaf_pair_count - leaf_pair_capacity);
  descend_trees(item);
}
