// One thread fits one leaf's box to the cages of its triangles, and its part of the boxes above.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
WRITE(control)
READ(leaf)
READ(node)
SHARED_WRITE(node_box)
READ(triangle)
READ(cage)
WRITE(arrival)
READ(partner_step)
#include "parts/boxes_in_motion.glsl"
#include "parts/refit.glsl"

void refit_cages(uint item) { refit_tree(item); }
