// One thread fits one leaf's box, and its part of the boxes above, to the cages of its triangles' corners.
#include "../physics/body.glsl"
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
READ(status)
#include "parts/boxes_in_motion.glsl"
Box box_of_triangle(uint t) {
  PaddedBox cages = box_of_cages(t);
  Box box;
  box.lower = vec3(cages.lower);
  box.upper = vec3(cages.upper);
  return box;
}
#include "parts/refit.glsl"

void refit_cages(uint item) { refit_tree(item); }
