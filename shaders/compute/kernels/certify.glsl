// A kernel in rounds, and with sieves. It proves that two triangles of different bodies stay apart while their corners move, or cuts these
// motions short. In a heap the ways of a third of the pairs overlap, and a normal proves all but a twelfth of these apart.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/separation.glsl"
#include "../physics/contact/surface.glsl"
#include "parts/certify_pairs.glsl"
#define SIEVES 3u

// If the list of pairs is full, no body moves.
uint items_in_a_round() {
  uint count = contact_list[0].triangle_pair_count;
  return count <= triangle_pair_capacity ? count : 0u;
}

// Has a pair go through a sieve, and returns whether it needs the next one. No answer changes within a round, so that it does not matter
// which pairs have gone through before. The later sieves share their code as far as they can: with a function for each, an H200 took four
// times as long.
bool needs_more(uint sieve, uint item, uint cut_round) {
  uvec2 triangles = listed_triangles(item);
  if (sieve == 0u) return ways_overlap(triangles);
  uint who[6];
  for (uint k = 0u; k < 3u; ++k) {
    who[k] = triangle[corner_of(triangles.x, k)];
    who[3u + k] = triangle[corner_of(triangles.y, k)];
  }
  if (sieve == 1u && !any_has_changed(who, cut_round)) return false;
  Case c = case_of(who, cut_round);
  Motion m = motion_to_prove(c, cut_round);
  if (sieve == 1u) return !need_no_axis(c, cut_round) && !a_normal_proves(m);
  if (!has_axis(m, way_to_first(m), false)) end_unproven(c, cut_round);
  return false;
}

// For the CPU.
void certify(uint item, uint cut_round) {
  for (uint sieve = 0u; sieve < SIEVES && needs_more(sieve, item, cut_round); ++sieve) {
  }
}
