// One thread fits one leaf's box to its triangles where they stand, and its part of the boxes above.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
WRITE(control)
READ(leaf)
READ(node)
SHARED_WRITE(node_box)
READ(triangle)
READ(world_position)
WRITE(arrival)
READ(status)
PARAMETER(uint, first_position)

#include "parts/box_of_triangle.glsl"
#include "parts/refit.glsl"

void refit(uint item) { refit_tree(item); }
