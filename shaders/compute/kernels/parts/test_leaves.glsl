// Tests those triangles of two leaves whose boxes overlap.
#include "node_boxes.glsl"
#include "box_of_triangle.glsl"
#include "test_triangles.glsl"

#ifdef __cplusplus
// The boxes of up to four triangles from one on. Behind the end the last one comes again.
struct FourBoxes { PaddedBox box[4]; };

FourBoxes boxes_of_four(uint first, uint end) {
  FourBoxes four;
  for (uint k = 0; k < 4; ++k) four.box[k] = box_of_triangle(min(first + k, end - 1));
  return four;
}

PaddedBox box_of_four(IN(FourBoxes) four) {
  return joined(joined(four.box[0], four.box[1]), joined(four.box[2], four.box[3]));
}

// One thread has all pairs. It compares four boxes with four before it looks at one result, because no processor foresees which overlap.
// First it leaves out four that miss all of the other leaf, unless that is to be compared at once.
void test_leaves(uvec2 leaves, uint, uint) {
  const uvec4 a = node[leaves.x], b = node[leaves.y];
  const PaddedBox of_second = box_of_node(leaves.y);
  uvec2 counts = uvec2(0u);
  for (uint s = a.z; s < a.w; s += 4) {
    const FourBoxes of_s = boxes_of_four(s, a.w);
    if (b.w - b.z > 4 && !overlaps(box_of_four(of_s), of_second)) continue;
    for (uint t = b.z; t < b.w; t += 4) {
      const FourBoxes of_t = boxes_of_four(t, b.w);
      uint near = 0;
#pragma GCC unroll 16
      for (uint k = 0; k < 16; ++k) near |= (overlaps(of_s.box[k / 4], of_t.box[k % 4]) ? 1u : 0u) << k;
      const uint of_s_there = 0xffffu >> (16 - 4 * min(a.w - s, 4u)), of_t_there = 0x1111u * (0xfu >> (4 - min(b.w - t, 4u)));
      near &= of_s_there & of_t_there;  // none behind an end
      for (; near != 0; near &= near - 1) {
        const uint k = uint(findLSB(near));
        counts += test_if(true, s + k / 4, t + k % 4);
      }
    }
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
