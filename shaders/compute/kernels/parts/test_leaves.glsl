// Tests those triangles of two leaves whose boxes overlap.
#include "node_boxes.glsl"
#include "box_of_triangle.glsl"
#include "test_triangles.glsl"

#ifdef __cplusplus
// Returns a bit for each two triangles whose boxes overlap: of up to four from s on with up to four from t on. They are all compared before
// anything depends on one of them, because no processor foresees which overlap.
uint near_of_four(uint s, uint end_s, uint t, uint end_t) {
  PaddedBox of_s[4], of_t[4];
  for (uint k = 0; k < 4; ++k) {
    of_s[k] = box_of_triangle(min(s + k, end_s - 1));
    of_t[k] = box_of_triangle(min(t + k, end_t - 1));
  }
  uint near = 0;
#pragma GCC unroll 16
  for (uint k = 0; k < 16; ++k) near |= (overlaps(of_s[k / 4], of_t[k % 4]) ? 1u : 0u) << k;
  const uint rows = 0xffffu >> (16 - 4 * min(end_s - s, 4u)), columns = 0x1111u * (0xfu >> (4 - min(end_t - t, 4u)));
  return near & rows & columns;
}

// One thread has all pairs.
void test_leaves(uvec2 leaves, uint, uint) {
  const uvec4 a = node[leaves.x], b = node[leaves.y];
  uvec2 counts = uvec2(0u);
  for (uint s = a.z; s < a.w; s += 4)
    for (uint t = b.z; t < b.w; t += 4)
      for (uint near = near_of_four(s, a.w, t, b.w); near != 0; near &= near - 1) {
        const uint k = uint(findLSB(near));
        counts += test_if(true, s + k / 4, t + k % 4);
      }
  count_tests(counts);
}
#else
// width * width threads share the pairs. Each takes every width-th triangle of either leaf.
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
#endif
