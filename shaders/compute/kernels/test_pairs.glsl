// One thread, or sixteen of them, test the pairs of triangles of two leaves. All threads share the list of leaf pairs in strides. If it was
// too short, all is left to test_unlisted_pairs.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
WRITE(control)
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
PARAMETER(uint, test_width)  // its square is the number of threads of a pair
#include "parts/test_leaves.glsl"

void test_pairs(uint item) {
  uint count = control[0].leaf_pair_count, threads = test_width * test_width;
  if (count > leaf_pair_capacity) return;
  for (uint k = item / threads; k < count; k += pairs_at_once) test_leaves(leaf_pair[k], item % threads, test_width);
}
