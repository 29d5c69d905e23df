// One thread serves one vertex at a step's start. It finds how the vertex is expected to move. It bounds place and motion by a cage that
// the vertex will not leave in this step, and its expected way by another box.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
WRITE(control)
READ(step_parts)
READ(surface)
READ(room)
READ(ground)
WRITE(cluster)
READ(rest_position)
READ(surplus)
READ(start)
WRITE(expected)
WRITE(cage)
WRITE(contact_list)
WRITE(contact_weight)
WRITE(body_box)
WRITE(status)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, ground_count)
#include "parts/bound.glsl"
#include "parts/flight.glsl"
#include "parts/height_above.glsl"
#include "parts/store_vertex_box.glsl"

void empty_lists() {
  contact_list[0].triangle_pair_count = 0u;
  contact_list[0].contact_count = 0u;
  contact_list[0].uncertified = 0u;
  contact_list[0].rounds_that_cut = 0u;
  contact_list[0].is_tried = control[0].time_step > double(0) ? 1u : 0u;
  contact_list[0].presses = 0u;
  contact_list[0].unsettled_round = 0u;
  contact_list[0].bounces_from = no_round;
  contact_list[0].bounce_round = no_round;
  contact_list[0].has_dues = 0u;
}

// How much further than expected a vertex may go, on all sides [m]. Bodies that are far from all others have more room. What quiet ones
// have does not depend on others.
double reach_beyond(uint b) {
  double edge = surface[b].edge;
  if (status[b].calm >= quiet) return reach_in_edges() * edge;
  if (status[b].folds != 0u) return reach_of_folds() * edge;
  return clamp(double(uintBitsToFloat(room[b].to_others)), reach_in_edges() * edge, double(1000) * edge);
}

// How others may change its velocity, at least or at most along each axis [m/s].
dvec3 least_push(uint b) {
  return dvec3(from_ordered_bits(room[b].least_push[0]), from_ordered_bits(room[b].least_push[1]),
               from_ordered_bits(room[b].least_push[2]));
}
dvec3 most_push(uint b) {
  return dvec3(from_ordered_bits(room[b].most_push[0]), from_ordered_bits(room[b].most_push[1]),
               from_ordered_bits(room[b].most_push[2]));
}

// An island of which a cage comes near a ground has no flight.
void end_flight_near_grounds(uint b, dvec3 lower, dvec3 upper) {
  for (uint g = 0u; g < ground_count; ++g) {
    if (height_above(g, lower, upper) < gap_above(ground[g], surface[b])) ATOMIC_STORE(cluster[cluster[b].island].is_beside_static, 1u);
  }
}

void begin_part(double time_step) {
  control[0].time_step = time_step;
  contact_list[0].last_part = step_parts[0].last;
  empty_lists();
}

// Without a kick [m/s]. That of a scripted body is known.
dvec3 expected_velocity(uint i, uint b, dvec3 position, double time_step) {
  if (status[b].activity == scripted) return time_step > double(0) ? way_of_cluster(b, time_step, position) / time_step : dvec3(0);
  return LOAD3(start, start_velocity_of(i)) + time_step * LOAD3(surplus, expected_surplus_of(i));
}

void keep_cage(uint i, uint b, vec3 lower, vec3 upper) {
  store_vertex_box(cage_of(i), lower, upper);
  for (uint k = 0u; k < 3u; ++k) bound(i, b, k, lower[int(k)], upper[int(k)]);
}

void expect_motion(uint i) {
  uint b = uint(rest_position[i].w);
  bool is_at_rest = is_idle(status[b]);
  double time_step = next_part(step_parts[0], control[0].time_left);
  if (i == 0u) begin_part(time_step);
  bool stays = is_at_rest || is_asleep(status[b]);
  dvec3 position = LOAD3(start, start_position_of(i)), mean = stays ? dvec3(0) : expected_velocity(i, b, position, time_step);
  dvec3 way = time_step * mean, end = position + way, lower = position, upper = position;
  if (surface[b].inverse_mass != double(0)) {
    // What others may push it further. Half an edge is what a heavy body gives to a light one by a quarter edge a step.
    dvec3 most = max(dvec3(double(0.5) * surface[b].edge), abs(way)), beyond = dvec3(reach_beyond(b));
    dvec3 together = may_fly(b) ? way_of_flight(b, time_step, position) : dvec3(0);
    lower += min(min(way, together), dvec3(0)) - beyond + max(time_step * least_push(b), -most);
    upper += max(max(way, together), dvec3(0)) + beyond + min(time_step * most_push(b), most);
    if (!is_at_rest) end_flight_near_grounds(b, lower, upper);
  } else {
    lower = min(position, end);
    upper = max(position, end);
  }
  // rounded outward: a float is off by at most 2^-24 of itself, whichever way it is rounded
  dvec3 slack = abs(position) * double(2.4e-7) + (upper - lower) * double(1.2e-7), near = dvec3(surface[b].nearness) + slack;
  store_vertex_box(way_box_of(i), vec3(min(position, end) - near), vec3(max(position, end) + near));
  contact_weight[i] = 0u;
  STORE3(expected, force_of(i), mean)
  if (is_at_rest) return;  // all else still stands, but the way that it went has been in the place of this box
  keep_cage(i, b, vec3(lower - slack), vec3(upper + slack));
}
