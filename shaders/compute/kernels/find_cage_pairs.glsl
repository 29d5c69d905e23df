// One thread takes one subtree of either tree of two near bodies, and lists the pairs of leaves whose boxes of cages overlap. If the list
// is full, it lists the pairs of their triangles itself.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/surface.glsl"
WRITE(control)
WRITE(contact_list)
READ(near_pair)
READ(node)
READ(node_box)
READ(triangle_bounds)
WRITE(cluster)
WRITE(leaf_pair)
WRITE(triangle_pair)
PARAMETER(uint, body_count)
PARAMETER(uint, leaf_pair_capacity)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(uint, first_start)
PARAMETER(uint, start_count)  // subtrees of a body
PARAMETER(uint, pairs_at_once)  // threads go on to later pairs in strides of this
#include "parts/list_triangles.glsl"

void found_leaves(uvec2 leaves) {
  uint at = atomicAdd(control[0].leaf_pair_count, 1u);
  if (at < leaf_pair_capacity)
    leaf_pair[at] = leaves;
  else
    list_triangles(leaves, 0u, 1u);
}

#include "parts/descend.glsl"

// Near bodies that are not of one cluster have no motion in common that cuts could leave alone.
void part_clusters() {
  for (uint k = 0u; k < control[0].near_pair_count; ++k) {
    uint first = cluster[near_pair[k].x].first, second = cluster[near_pair[k].y].first;
    if (first != second) cluster[first].is_met = cluster[second].is_met = 1u;
  }
}

void find_cage_pairs(uint item) {
  if (item == 0u && cluster[body_count].bodies != 0u) part_clusters();
  descend_trees(item);
}
