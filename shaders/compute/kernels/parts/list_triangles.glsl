// Lists the pairs of two leaves' triangles whose boxes of cages overlap. It takes every `stride`-th triangle of the first leaf, from
// `first` on. Pairs are counted beyond the list's end, too, which says that it is full.
#include "kept_boxes.glsl"

// Lists pairs of s with those of up to 32 triangles from t on that are set in `near`.
void list_pairs(uint s, uint t, uint near, uint meeting) {
  if (ATOMIC_LOAD(contact_list[0].triangle_pair_count) > triangle_pair_capacity) return;  // the count could pass 2^32
  uint at = atomicAdd(contact_list[0].triangle_pair_count, uint(bitCount(near)));
  for (; near != 0u; near &= near - 1u) {
    uint k = uint(findLSB(near));
    if (at < triangle_pair_capacity) triangle_pair[at] = uvec2(s, (t + k) | ((meeting >> k & 1u) != 0u ? ways_meet : 0u));
    ++at;
  }
}

void list_triangles(uvec2 leaves, uint first, uint stride) {
  uvec4 a = node[leaves.x], b = node[leaves.y];
  for (uint s = a.z + first; s < a.w; s += stride) {
    PaddedBox cages = kept_box(triangle_cage_of(s)), ways = kept_box(triangle_way_box_of(s));
    for (uint t = b.z; t < b.w; t += 32u) {
      uint near = 0u, meeting = 0u;
      for (uint k = 0u; k < min(b.w - t, 32u); ++k) {
        if (!overlaps(cages, kept_box(triangle_cage_of(t + k)))) continue;
        near |= 1u << k;
        if (overlaps(ways, kept_box(triangle_way_box_of(t + k)))) meeting |= 1u << k;
      }
      if (near != 0u) list_pairs(s, t, near, meeting);
    }
  }
}
