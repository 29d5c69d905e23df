// Proofs that two triangles stay apart while their corners move, and cuts of motions that are not proven. The kernel goes in rounds, and a
// round sees the cuts of the rounds before.
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
SHARED_WRITE(cut)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(double, largest_body)  // radius at rest [m]
#include "boxes_in_motion.glsl"
#include "flight.glsl"
#include "cut_before.glsl"

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

// Whether the triangles stay apart without an axis that proves it. If they fly along together, rounding alone moves them against each
// other, and an earlier proof let them come so near. Where a million steps do not use up its margin, no other proof is needed. In fp32 one
// could fail: between large triangles that are very near each other it does not find an axis well enough.
bool need_no_axis(IN(Case) c, uint cut_round) {
  if (!all_stopped(c)) return false;
  if (!flies(c.vertex[0], cut_round) && !flies(c.vertex[3], cut_round)) return true;
  return c.outlasts_rounding && fly_together(c, cut_round);
}

// What an axis has to prove. Of triangles that fly along together it is that they stand apart by half the margin.
Motion motion_to_prove(IN(Case) c, uint cut_round) {
  Motion m = c.motion;
  if (!all_stopped(c) || !fly_together(c, cut_round)) return m;
  for (uint k = 0u; k < 6u; ++k) m.end[k] = m.start[k];
  m.margin *= real(0.5);
  return m;
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

// What follows if triangles are not proven to stay apart.
void end_unproven(IN(Case) c, uint cut_round) {
  if (cut_round + 1u == cut_rounds)
    atomicAdd(contact_list[0].uncertified, 1u);
  else
    cut_short(c, cut_round);
}

// Triangles at a place in the list, in leaf order.
uvec2 listed_triangles(uint item) { return uvec2(triangle_pair[item].x, triangle_pair[item].y & ~ways_meet); }

bool ways_overlap(uvec2 triangles) { return overlaps(box_of_ways(triangles.x), box_of_ways(triangles.y)); }

bool any_has_changed(IN_ARRAY(uint, who, 6), uint cut_round) {
  bool changed = false;
  for (uint k = 0u; k < 6u; ++k) changed = changed || has_changed(who[k], cut_round);
  return changed;
}
