// One thread tests a sixteenth of the pairs of triangles of two leaves. All threads share the list of leaf pairs in strides. If it was too
// short, all is left to test_unlisted_pairs.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
WRITE(control)
READ(leaf_pair)
READ(node)
READ(triangle)
READ(world_position)
WRITE(mark)
PARAMETER(uint, first_position)
PARAMETER(uint, triangle_test)
PARAMETER(uint, leaf_pair_capacity)
PARAMETER(uint, pairs_at_once)
#include "parts/test_leaves.glsl"

void test_pairs(uint item) {
  uint count = control[0].leaf_pair_count, part = item % threads_per_leaf_pair;
  if (count > leaf_pair_capacity) return;
  for (uint k = item / threads_per_leaf_pair; k < count; k += pairs_at_once)
    test_leaves(leaf_pair[k], uvec2(part / 4u, part % 4u), 4u);
}
