// One thread, or a few of them, list the pairs of triangles of two leaves whose cages overlap. All threads share the list of leaf pairs in
// strides. If it was too short, all is left to list_unlisted_pairs.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/surface.glsl"
READ(control)
READ(leaf_pair)
PARAMETER(uint, leaf_pair_capacity)
PARAMETER(uint, pairs_at_once)
PARAMETER(uint, threads_of_a_pair)
#include "parts/list_triangles.glsl"

void list_triangle_pairs(uint item) {
  uint count = control[0].leaf_pair_count;
  if (count > leaf_pair_capacity) return;
  for (uint k = item / threads_of_a_pair; k < count; k += pairs_at_once)
    list_triangles(leaf_pair[k], item % threads_of_a_pair, threads_of_a_pair);
}
