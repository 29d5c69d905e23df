// A group kernel. It fits the box of a treelet's root to where its vertices stand.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/treelet.glsl"
WRITE(control)
READ(status)
READ(tree)
READ(treelet)
READ(treelet_vertex)
WRITE(node_box)
READ(world_position)
PARAMETER(uint, first_position)

PaddedBox box_of_vertex(uint v) {
  PaddedBox box;
  box.lower = box.upper = world_position[first_position + v];
  return box;
}
#include "parts/store_node_box.glsl"
#include "parts/bound_treelet.glsl"

void bound_treelets(uint item) { bound_treelet(item); }
