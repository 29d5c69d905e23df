// One thread bounds the triangles of one leaf, by their corners' cages and ways. It fits the leaf's box and its part of the boxes above to
// the cages.
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
WRITE(triangle_bounds)
WRITE(arrival)
READ(status)
#include "parts/boxes_in_motion.glsl"
#include "parts/kept_boxes.glsl"
Box box_of_triangle(uint t) {
  PaddedBox kept = kept_box(triangle_cage_of(t));
  Box box;
  box.lower = vec3(kept.lower);
  box.upper = vec3(kept.upper);
  return box;
}
#include "parts/refit.glsl"

void keep_box(uint at, IN(PaddedBox) box) {
  triangle_bounds[at] = box.lower;
  triangle_bounds[at + 1u] = box.upper;
}

void bound_triangles(uint begin, uint end) {
  for (uint t = begin; t < end; ++t) {
    keep_box(triangle_cage_of(t), box_of_cages(t));
    keep_box(triangle_way_box_of(t), box_of_ways(t));
  }
}

void refit_cages(uint item) {
  if (status[leaf[item].y].partner_step != control[0].step) return;
  bound_triangles(node[leaf[item].x].z, node[leaf[item].x].w);
  refit_tree(item);
}
