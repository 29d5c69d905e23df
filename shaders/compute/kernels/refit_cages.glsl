// One thread bounds the triangles of one leaf, by their corners' cages and ways. It fits the leaf's box and its part of the boxes above to
// the cages.
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
READ(partner_step)
#include "parts/boxes_in_motion.glsl"
#include "parts/kept_boxes.glsl"
Box box_of_triangle(uint t) { return kept_box(triangle_cage_of(t)); }
#include "parts/refit.glsl"

void keep_box(uint at, IN(Box) box) {
  triangle_bounds[at] = vec4(box.lower, 0);
  triangle_bounds[at + 1u] = vec4(box.upper, 0);
}

void bound_triangles(uint begin, uint end) {
  for (uint t = begin; t < end; ++t) {
    keep_box(triangle_cage_of(t), box_of_cages(t));
    keep_box(triangle_way_box_of(t), box_of_ways(t));
  }
}

void refit_cages(uint item) {
  if (partner_step[leaf[item].y] != control[0].step) return;
  bound_triangles(node[leaf[item].x].z, node[leaf[item].x].w);
  refit_tree(item);
}
