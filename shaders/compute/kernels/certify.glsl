// A kernel in rounds. One thread proves that two triangles stay apart while their corners move, or cuts these motions short. A round sees
// the cuts of the rounds before. Of a body that meets itself one thread proves instead, if it can, that a triangle stays part of a star.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/separation.glsl"
#include "../physics/contact/star.glsl"
#include "../physics/contact/surface.glsl"
SHARED_WRITE(contact_list)
READ(triangle)
READ(triangle_pair)
READ(start)
READ(way)
READ(cage)
READ(control)
READ(status)
READ(rest_position)
READ(pose)
READ(cluster)
READ(surface)
READ(place_box)
SHARED_WRITE(cut)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(double, largest_body)  // radius at rest [m]
PARAMETER(uint, triangles_if_watched)  // all of them if a body meets itself, and else 0
#include "parts/boxes_in_motion.glsl"
#include "parts/star_centre.glsl"
#include "parts/flight.glsl"
#include "parts/cut_before.glsl"

// If the list of pairs is full, no body moves.
uint items_in_a_round() {
  uint count = contact_list[0].triangle_pair_count;
  return count <= triangle_pair_capacity ? count + triangles_if_watched : 0u;
}
uint rounds_at_most() { return cut_rounds; }
bool goes_on(uint cut_round) { return contact_list[0].rounds_that_cut > cut_round; }

uint body_of(uint i) { return uint(rest_position[i].w); }

// Whether the vertex has a flight that no round before this one has stopped.
bool flies(uint i, uint cut_round) {
  uint b = body_of(i);
  return has_flight(b) && ATOMIC_LOAD(cut[flight_stop_of(vertex_count, flight_of(b))]) >= cut_round;
}

// Whether a round before this one stopped it.
bool lost_flight(uint i, uint cut_round) { return has_flight(body_of(i)) && !flies(i, cut_round); }

bool has_changed(uint i, uint cut_round) {
  if (cut_round == 0u || (lost_flight(i, cut_round) && flies(i, cut_round - 1u))) return true;
  if (ATOMIC_LOAD(cut[stop_of(vertex_count, i)]) == cut_round - 1u) return true;
  return cut_round <= plane_rounds && cut[cut_in(cut_round, vertex_count, i)] < cut_before(i, cut_round - 1u);
}

struct Case {
  uint vertex[6];
  real part[6];       // of its way that a vertex goes so far
  real3 together[6];  // its flight, which it goes in any case [m]
  Motion motion;
  bool outlasts_rounding;  // the margin, while only rounding in fp64 moves the triangles against each other
  uvec2 corner;            // which one of either that they share, or no_corner
};

// How a vertex goes by its flight, and the part of its way beside that as cuts leave it so far.
struct WaySoFar {
  dvec3 together;  // [m]
  dvec3 own;       // all of it [m]
  real part;
};

WaySoFar way_so_far(uint i, dvec3 place, uint cut_round) {
  uint b = body_of(i);
  bool lost = lost_flight(i, cut_round);
  dvec3 flight = flight_in_step(b, place);
  WaySoFar w;
  w.together = lost ? dvec3(0) : flight;
  w.own = LOAD3(way, force_of(i));
  if (lost) w.own += flight;
  w.part = lost && !goes_on_alone(i, b) ? real(0) : real(uintBitsToFloat(cut_before(i, cut_round)));
  return w;
}

double far_centre_of(uint i) { return sum_of_sizes(LOAD3(pose[body_of(i)].origin, 0u)); }

Case case_of(IN_ARRAY(uint, who, 6), uint cut_round) {
  Case c;
  dvec3 origin = LOAD3(start, start_position_of(who[0]));
  real size = real(0);
  double far = rounded_from(sum_of_sizes(origin), max(far_centre_of(who[0]), far_centre_of(who[3])), largest_body);
  for (uint k = 0u; k < 6u; ++k) {
    dvec3 place = LOAD3(start, start_position_of(who[k])), from = place - origin;
    WaySoFar w = way_so_far(who[k], place, cut_round);
    c.vertex[k] = who[k];
    c.part[k] = w.part;
    c.motion.start[k] = real3(from);
    c.motion.end[k] = real3(from + w.together + double(w.part) * w.own);
    c.together[k] = real3(w.together);
    real3 reach = max(abs(c.motion.start[k]), abs(c.motion.end[k]));
    size = max(size, (reach.x + reach.y) + reach.z);
  }
  c.motion.margin = real(margin_of_rounding(double(real_epsilon), double(size), far));
  c.outlasts_rounding = margin_outlasts_rounding(double(real_epsilon), double(size), far);
  return c;
}

// How far corners go against the axis beyond `limit`, at most, by their own ways [m].
real trespass(IN(Case) c, uint first, IN(real3) axis, real limit) {
  real most = real(0);
  for (uint k = first; k < first + 3u; ++k) most = max(most, limit - dot(axis, c.motion.end[k] - c.together[k]));
  return most;
}

// Lets no corner pass the plane at `limit` on the axis. Returns whether one would.
bool stop_at(IN(Case) c, uint first, IN(real3) axis, real limit, uint cut_round) {
  bool stops = false;
  for (uint k = first; k < first + 3u; ++k) {
    real from = dot(axis, c.motion.start[k]), to = dot(axis, c.motion.end[k] - c.together[k]);
    if (to >= limit) continue;
    float part = float(max(c.part[k] * ((from - limit) / (from - to)), real(0))) * 0.999999f;
    stops = true;
    atomicMin(cut[cut_in(cut_round + 1u, vertex_count, c.vertex[k])], floatBitsToUint(part));
  }
  return stops;
}

void stop_all(IN(Case) c, uint cut_round) {
  for (uint k = 0u; k < 6u; ++k) atomicMin(cut[stop_of(vertex_count, c.vertex[k])], cut_round);
}

// Whether no corner makes a motion of its own.
bool all_stopped(IN(Case) c) {
  bool all = true;
  for (uint k = 0u; k < 6u; ++k) all = all && c.part[k] == real(0);
  return all;
}

// Whether triangles whose corners make no motions of their own have one flight, which leaves their distance.
bool fly_together(IN(Case) c, uint cut_round) {
  return flies(c.vertex[0], cut_round) && flies(c.vertex[3], cut_round) && have_one_flight(body_of(c.vertex[0]), body_of(c.vertex[3]));
}

const real shortest_piece = real(1) / real(256);  // of the time of a step, for triangles of one body

// Whether the triangles stay apart. If they fly along together, rounding alone moves them against each other, and an earlier proof let them
// come so near. Where a million steps do not use up its margin, no other proof is needed. In fp32 one could fail: between large triangles
// that are very near each other it does not find an axis well enough. Elsewhere they are proven to stand apart by half the margin.
// There is one call of each proof, because compilers for GPUs write it out for each.
bool are_proven(Case c, uint cut_round) {
  if (all_stopped(c)) {
    if (!flies(c.vertex[0], cut_round) && !flies(c.vertex[3], cut_round)) return true;
    if (fly_together(c, cut_round)) {
      if (c.outlasts_rounding) return true;
      for (uint k = 0u; k < 6u; ++k) c.motion.end[k] = c.motion.start[k];
      c.motion.margin *= real(0.5);
    }
  }
  bool is_own = body_of(c.vertex[0]) == body_of(c.vertex[3]);
  return stays_apart_in_pieces(c.motion, int(c.corner.x), int(c.corner.y), is_own ? shortest_piece : real(1));
}

void stop_flight(uint i, uint cut_round) {
  if (flies(i, cut_round)) atomicMin(cut[flight_stop_of(vertex_count, flight_of(body_of(i)))], cut_round);
}

// How far the corners of a triangle reach against the axis before they make motions of their own. A scripted body sweeps over its flight.
real least_along(IN(Case) c, uint first, IN(real3) axis) {
  real least = min(min(dot(axis, c.motion.start[first]), dot(axis, c.motion.start[first + 1u])), dot(axis, c.motion.start[first + 2u]));
  if (status[body_of(c.vertex[first])].activity != scripted) return least;
  for (uint k = first; k < first + 3u; ++k) least = min(least, dot(axis, c.motion.end[k]));
  return least;
}

void cut_short(IN(Case) c, uint cut_round) {
  atomicMax(contact_list[0].rounds_that_cut, cut_round + 1u);
  for (uint k = 0u; k < 6u; ++k) atomicMin(cut[stop_of(vertex_count, c.vertex[k])], at_a_cut);
  if (all_stopped(c)) {
    stop_flight(c.vertex[0], cut_round);
    stop_flight(c.vertex[3], cut_round);
    return;
  }
  Closest at = closest_points(c.motion.start);
  if (cut_round >= plane_rounds || !(at.distance > real(32) * c.motion.margin)) {
    stop_all(c, cut_round);
    return;
  }
  real3 axis = at.away / at.distance;
  real lowest = least_along(c, 0u, axis), highest = -least_along(c, 3u, -axis);
  real usable = real(0.8) * ((lowest - highest) - real(2) * c.motion.margin);
  if (!(usable > real(0))) {
    stop_all(c, cut_round);
    return;
  }
  real of_first = trespass(c, 0u, axis, lowest), of_second = trespass(c, 3u, -axis, -highest);
  real share = of_first + of_second > real(0) ? of_first / (of_first + of_second) : real(0);
  bool first_stops = stop_at(c, 0u, axis, lowest - share * usable, cut_round);
  bool second_stops = stop_at(c, 3u, -axis, -(highest + (real(1) - share) * usable), cut_round);
  if (!first_stops && !second_stops) stop_all(c, cut_round);
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

// How many corners two triangles share, and the place of the last such corner in either, or no_corner.
uvec3 common_corners(IN_ARRAY(uint, who, 6)) {
  uvec3 found = uvec3(0u, no_corner, no_corner);
  for (uint j = 0u; j < 3u; ++j)
    for (uint k = 0u; k < 3u; ++k)
      if (who[j] == who[3u + k]) found = uvec3(found.x + 1u, j, k);
  return found;
}

void certify(uint item, uint cut_round) {
  uint pairs = contact_list[0].triangle_pair_count;
  if (item >= pairs) {
    certify_star(item - pairs, cut_round);
    return;
  }
  uvec2 triangles = uvec2(triangle_pair[item].x, triangle_pair[item].y & ~ways_meet);
  if (!overlaps(box_of_ways(triangles.x), box_of_ways(triangles.y))) return;
  uint who[6];
  bool changed = false;
  for (uint k = 0u; k < 3u; ++k) {
    who[k] = triangle[corner_of(triangles.x, k)];
    who[3u + k] = triangle[corner_of(triangles.y, k)];
  }
  for (uint k = 0u; k < 6u; ++k) changed = changed || has_changed(who[k], cut_round);
  if (!changed) return;
  uvec3 both = body_of(who[0]) == body_of(who[3]) ? common_corners(who) : uvec3(0u, no_corner, no_corner);
  if (both.x > 1u) return;  // they share an edge
  Case c = case_of(who, cut_round);
  c.corner = uvec2(both.y, both.z);
  if (are_proven(c, cut_round)) return;
  if (cut_round + 1u == cut_rounds)
    atomicAdd(contact_list[0].uncertified, 1u);
  else
    cut_short(c, cut_round);
}
