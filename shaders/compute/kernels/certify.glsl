// A kernel in rounds. One thread proves that two triangles of different bodies stay apart while their corners move, or cuts these motions
// short.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/separation.glsl"
#include "../physics/contact/surface.glsl"
#include "parts/certify_pairs.glsl"

// If the list of pairs is full, no body moves.
uint items_in_a_round() {
  uint count = contact_list[0].triangle_pair_count;
  return count <= triangle_pair_capacity ? count : 0u;
}

void certify(uint item, uint cut_round) {
  uvec2 triangles = listed_triangles(item);
  if (!ways_overlap(triangles)) return;
  uint who[6];
  for (uint k = 0u; k < 3u; ++k) {
    who[k] = triangle[corner_of(triangles.x, k)];
    who[3u + k] = triangle[corner_of(triangles.y, k)];
  }
  if (!any_has_changed(who, cut_round)) return;
  Case c = case_of(who, cut_round);
  if (!need_no_axis(c, cut_round) && !stays_apart(motion_to_prove(c, cut_round))) end_unproven(c, cut_round);
}
