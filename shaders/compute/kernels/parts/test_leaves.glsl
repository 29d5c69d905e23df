// Tests those triangles of two leaves whose boxes overlap. It takes every `stride`-th triangle of either leaf, from `first` on.
#include "box_of_triangle.glsl"
#include "mark_contact.glsl"

void test_leaves(uvec2 leaves, uvec2 first, uint stride) {
  uvec4 a = node[leaves.x], b = node[leaves.y];
  uint tests = 0u;
  for (uint s = a.z + first.x; s < a.w; s += stride) {
    Box box = box_of_triangle(s);
    for (uint t = b.z + first.y; t < b.w; t += stride) {
      if (!overlaps(box, box_of_triangle(t))) continue;
      mark_contact(s, t);
      ++tests;
    }
  }
  TALLY_UP(control[0].count[triangle_tests], tests)
}
