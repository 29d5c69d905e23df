// A group kernel. Where the list of leaf pairs was too short, it descends trees as find_pairs does, and lists the triangles of the leaves
// that it finds.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/treelet.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/surface.glsl"
WRITE(control)
PARAMETER(uint, leaf_pair_capacity)
#include "parts/list_triangles.glsl"
void found_leaves(uvec2 leaves) { list_triangles(leaves, 0u, 1u); }
#include "parts/descend.glsl"

void list_unlisted_pairs(uint item) {
  if (control[0].leaf_pair_count <= leaf_pair_capacity) return;
  if (item == 0u && THREAD == 0u) atomicAdd(control[0].count[pairs_beyond_capacity], control[0].leaf_pair_count - leaf_pair_capacity);
  descend_trees(item);
}
