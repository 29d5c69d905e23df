// Tests those triangles of two leaves whose boxes overlap. width * width threads share them. Each takes every width-th triangle of either
// leaf.
#include "node_boxes.glsl"
#include "box_of_triangle.glsl"
#include "mark_contact.glsl"

// Looks at triangles t, t + width, and so on, up to 32 of them before `end`. Bit k of the result says whether the box of number k overlaps
// the given one. Processors can't foresee that, so there is no branch for it.
uint overlapping(IN(PaddedBox) box, uint t, uint end, uint width) {
  uint near = 0u;
  for (uint k = 0u; t < end && k < 32u; t += width, ++k) near |= (overlaps(box, box_of_triangle(t)) ? 1u : 0u) << k;
  return near;
}

void test_leaves(uvec2 leaves, uint part, uint width) {
  uvec4 a = node[leaves.x], b = node[leaves.y];
  PaddedBox of_second = box_of_node(leaves.y);
  uint tests = 0u, touching = 0u;
  for (uint first = a.z + part / width; first < a.w; first += 32u * width) {
    for (uint of_first = overlapping(of_second, first, a.w, width); of_first != 0u; of_first &= of_first - 1u) {
      uint s = first + width * uint(findLSB(of_first));
      PaddedBox box = box_of_triangle(s);
      for (uint second = b.z + part % width; second < b.w; second += 32u * width) {
        for (uint near = overlapping(box, second, b.w, width); near != 0u; near &= near - 1u) {
          touching += mark_contact(s, second + width * uint(findLSB(near)));
          ++tests;
        }
      }
    }
  }
  TALLY_UP(control[0].count[triangle_tests], tests)
  TALLY_UP(control[0].count[contact_pairs], touching)
}
