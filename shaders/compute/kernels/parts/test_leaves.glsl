// Tests those triangles of two leaves whose boxes overlap. width * width threads share them. Each takes every width-th triangle of either
// leaf.
#include "node_boxes.glsl"
#include "box_of_triangle.glsl"
#include "mark_contact.glsl"

void test_leaves(uvec2 leaves, uint part, uint width) {
  uvec4 a = node[leaves.x], b = node[leaves.y];
  PaddedBox of_second = box_of_node(leaves.y);
  uint tests = 0u, touching = 0u;
  for (uint s = a.z + part / width; s < a.w; s += width) {
    PaddedBox box = box_of_triangle(s);
    if (!overlaps(box, of_second)) continue;
    for (uint t = b.z + part % width; t < b.w; t += width) {
      if (!overlaps(box, box_of_triangle(t))) continue;
      touching += mark_contact(s, t);
      ++tests;
    }
  }
  TALLY_UP(control[0].count[triangle_tests], tests)
  TALLY_UP(control[0].count[contact_pairs], touching)
}
