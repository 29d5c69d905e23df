// `certify` for scenes in which a body meets itself. Triangles of a pair may be of one body then. Of a body that is a star one thread
// proves instead, if it can, that a triangle stays part of it. It is a kernel of its own because it takes more of a GPU's memory.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/separation.glsl"
#include "../physics/contact/star.glsl"
#include "../physics/contact/surface.glsl"
READ(surface)
READ(place_box)
PARAMETER(uint, triangle_count)
#include "parts/certify_pairs.glsl"
#include "parts/star_centre.glsl"

// Listed pairs, and then all triangles. If the list of pairs is full, no body moves.
uint items_in_a_round() {
  uint count = contact_list[0].triangle_pair_count;
  return count <= triangle_pair_capacity ? count + triangle_count : 0u;
}

// The triangle's corners, relative to a place that flies along with the body, if it flies.
Facet facet_of(uint b, IN_ARRAY(uint, who, 3), uint cut_round, OUT(bool) all_stand) {
  dvec3 centre = star_centre(b), centre_way = flies(who[0], cut_round) ? flight_in_step(b, centre) : dvec3(0);
  Facet f;
  all_stand = true;
  for (uint k = 0u; k < 3u; ++k) {
    dvec3 place = LOAD3(start, start_position_of(who[k])), from = place - centre;
    WaySoFar w = way_so_far(who[k], place, cut_round);
    f.start[k] = real3(from);
    f.end[k] = real3(from + (w.together - centre_way) + double(w.part) * w.own);
    all_stand = all_stand && w.part == real(0);
  }
  return f;
}

// Proves that a triangle of a star stays part of it. Then the body does not meet itself. Where it may, pairs of its triangles are listed.
void certify_star(uint t, uint cut_round) {
  uint b = body_of(triangle[corner_of(t, 0u)]);
  if (surface[b].meets_itself == 0u || status[b].folds != 0u || is_still(status[b])) return;
  uint who[3];
  bool changed = false;
  for (uint k = 0u; k < 3u; ++k) {
    who[k] = triangle[corner_of(t, k)];
    changed = changed || has_changed(who[k], cut_round);
  }
  if (!changed) return;
  bool all_stand;
  Facet f = facet_of(b, who, cut_round, all_stand);
  if (faces_out(f, real(surface[b].winding), rounding_of_places(b, star_centre(b)))) return;
  if (cut_round + 1u == cut_rounds || (all_stand && !flies(who[0], cut_round))) {
    atomicAdd(contact_list[0].uncertified, 1u);
    return;
  }
  atomicMax(contact_list[0].rounds_that_cut, cut_round + 1u);
  for (uint k = 0u; k < 3u; ++k) atomicMin(cut[stop_of(vertex_count, who[k])], cut_round);
  if (all_stand) stop_flight(who[0], cut_round);
}

const real shortest_piece = real(1) / real(256);  // of the time of a step, for triangles of one body

// How many corners two triangles share, and the place of the last such corner in either, or 0.
uvec3 common_corners(IN_ARRAY(uint, who, 6)) {
  uvec3 found = uvec3(0u);
  for (uint j = 0u; j < 3u; ++j)
    for (uint k = 0u; k < 3u; ++k)
      if (who[j] == who[3u + k]) found = uvec3(found.x + 1u, j, k);
  return found;
}

void certify_pair(uint item, uint cut_round) {
  uvec2 triangles = listed_triangles(item);
  if (!ways_overlap(triangles)) return;
  uint who[6];
  for (uint k = 0u; k < 3u; ++k) {
    who[k] = triangle[corner_of(triangles.x, k)];
    who[3u + k] = triangle[corner_of(triangles.y, k)];
  }
  if (!any_has_changed(who, cut_round)) return;
  uvec3 both = common_corners(who);
  if (both.x > 1u) return;          // they share an edge
  for (uint k = 0u; k < 3u; ++k) {  // a corner that they share comes first
    who[k] = triangle[corner_of(triangles.x, (both.y + k) % 3u)];
    who[3u + k] = triangle[corner_of(triangles.y, (both.z + k) % 3u)];
  }
  real shortest = body_of(who[0]) == body_of(who[3]) ? shortest_piece : real(1);
  Case c = case_of(who, cut_round);
  if (!need_no_axis(c, cut_round) && !stays_apart_in_pieces(motion_to_prove(c, cut_round), both.x == 1u, shortest))
    end_unproven(c, cut_round);
}

void certify_self_contact(uint item, uint cut_round) {
  uint pairs = contact_list[0].triangle_pair_count;
  if (item < pairs)
    certify_pair(item, cut_round);
  else
    certify_star(item - pairs, cut_round);
}
