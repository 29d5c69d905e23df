// A group kernel. It fits the box of a treelet's root to the cages of its vertices.
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
READ(cage)

#include "parts/load_vertex_box.glsl"
PaddedBox box_of_vertex(uint v) { return load_vertex_box(cage_of(v)); }
#include "parts/store_node_box.glsl"
#include "parts/bound_treelet.glsl"

void bound_cage_treelets(uint item) { bound_treelet(item); }
