// Tests those triangles of two leaves whose boxes overlap. width * width threads share them. Each takes every width-th triangle of either
// leaf.
#include "node_boxes.glsl"
#include "box_of_triangle.glsl"
#include "test_triangles.glsl"

void test_leaves(uvec2 leaves, uint part, uint width) {
  uvec4 a = node[leaves.x], b = node[leaves.y];
  PaddedBox of_second = box_of_node(leaves.y);
  uvec2 counts = uvec2(0u);
  for (uint s = a.z + part / width; s < a.w; s += width) {
    PaddedBox box = box_of_triangle(s);
    if (!overlaps(box, of_second)) continue;
    for (uint t = b.z + part % width; t < b.w; t += width) counts += test_if(overlaps(box, box_of_triangle(t)), s, t);
  }
  count_tests(counts);
}
