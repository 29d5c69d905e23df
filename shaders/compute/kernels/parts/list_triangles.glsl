// Lists the pairs of two leaves' triangles whose boxes of cages overlap. It takes every `stride`-th triangle of the first leaf, from
// `first` on. Pairs are counted beyond the list's end, too.
#include "kept_boxes.glsl"

void list_triangles(uvec2 leaves, uint first, uint stride) {
  uvec4 a = node[leaves.x], b = node[leaves.y];
  for (uint s = a.z + first; s < a.w; s += stride) {
    Box cages = kept_box(triangle_cage_of(s)), ways = kept_box(triangle_way_box_of(s));
    for (uint t = b.z; t < b.w; ++t) {
      if (!overlaps_at_once(cages, kept_box(triangle_cage_of(t)))) continue;
      uint mark = overlaps_at_once(ways, kept_box(triangle_way_box_of(t))) ? ways_meet : 0u;
      uint at = atomicAdd(contact_list[0].triangle_pair_count, 1u);
      if (at < triangle_pair_capacity) triangle_pair[at] = uvec2(s, t | mark);
    }
  }
}
