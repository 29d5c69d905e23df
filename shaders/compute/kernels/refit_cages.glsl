// A group kernel. It fits the boxes of a treelet's nodes to the cages of the triangles' corners.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/treelet.glsl"
WRITE(control)
READ(status)
READ(tree)
READ(treelet)
READ(treelet_step)
READ(node)
SHARED_WRITE(node_box)
READ(triangle)
READ(cage)
PARAMETER(uint, treelet_pair_capacity)

#include "parts/boxes_in_motion.glsl"
PaddedBox box_of_triangle(uint t) { return box_of_cages(t); }
#include "parts/node_boxes.glsl"
#include "parts/store_node_box.glsl"
#include "parts/refit.glsl"

void refit_cages(uint item) { refit_treelet(item); }
