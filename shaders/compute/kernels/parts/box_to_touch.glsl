// The box of a body that may touch others [m]. That of any other body is empty. Needs the arrays `tree`, `body_box` and `status`.
#include "box_of_body.glsl"

Box box_to_touch(uint b) {
  bool has_triangles = tree[b].y != 0u, is_finite = status[b].non_finite_vertex == no_vertex;
  Box box = box_of_body(b);  // loaded with the others, because waiting for one after the other costs more
  if (!has_triangles || !is_finite) box = empty_box();
  return box;
}
