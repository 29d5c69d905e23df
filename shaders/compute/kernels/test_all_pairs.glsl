// One thread tests one triangle of the first body of a near pair against every triangle of the second. Boxes come first, as in the
// trees' leaves. This is the search without trees, for comparison.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
WRITE(control)
READ(near_pair)
READ(triangle)
READ(world_position)
WRITE(mark)
READ(tree)
PARAMETER(uint, first_position)
PARAMETER(uint, triangle_test)
PARAMETER(uint, threads_per_pair)
PARAMETER(uint, pairs_at_once)
#include "parts/box_of_triangle.glsl"
#include "parts/test_triangles.glsl"

void test_all_pairs(uint item) {
  for (uint k = item / threads_per_pair; k < control[0].near_pair_count; k += pairs_at_once) {
    uvec4 first = tree[near_pair[k].x], second = tree[near_pair[k].y];
    uint s = first.z + item % threads_per_pair;
    if (s >= first.w) continue;
    PaddedBox box = box_of_triangle(s);
    uvec2 counts = uvec2(0u);
    for (uint t = second.z; t < second.w; ++t) counts += test_if(overlaps(box, box_of_triangle(t)), s, t);
    TALLY_UP(control[0].count[node_tests], second.w - second.z)
    count_tests(counts);
  }
}
