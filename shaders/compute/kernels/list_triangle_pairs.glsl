// One thread lists a quarter of the pairs of triangles of two leaves whose cages overlap. All threads share the list of leaf pairs in
// strides.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/surface.glsl"
READ(control)
READ(leaf_pair)
PARAMETER(uint, leaf_pair_capacity)
PARAMETER(uint, pairs_at_once)
#include "parts/list_triangles.glsl"

void list_triangle_pairs(uint item) {
  uint count = min(control[0].leaf_pair_count, leaf_pair_capacity);
  for (uint k = item / 4u; k < count; k += pairs_at_once) list_triangles(leaf_pair[k], item % 4u, 4u);
}
