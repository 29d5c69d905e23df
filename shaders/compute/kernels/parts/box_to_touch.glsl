// The box of a body that may touch others [m]. That of any other body is empty. Needs the arrays `tree`, `body_box` and `status`.
#include "box_of_body.glsl"

Box box_to_touch(uint b) {
  return tree[b].y != 0u && status[b].non_finite_vertex == no_vertex ? box_of_body(b) : empty_box();
}
