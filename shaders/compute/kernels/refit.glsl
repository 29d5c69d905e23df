// A group kernel. It fits the boxes of a treelet's nodes to the triangles where they stand.
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
READ(world_position)
PARAMETER(uint, first_position)
PARAMETER(uint, treelet_pair_capacity)

#include "parts/box_of_triangle.glsl"
#include "parts/node_boxes.glsl"
#include "parts/store_node_box.glsl"
#include "parts/refit.glsl"

void refit(uint item) { refit_treelet(item); }
