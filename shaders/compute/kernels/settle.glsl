// One thread ends one vertex's step where its motion was cut short, and keeps what the next step expects of it.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
#include "../physics/contact/surplus.glsl"
WRITE(control)
READ(body)
READ(pose)
WRITE(status)
READ(rest_position)
WRITE(placement)
WRITE(motion)
WRITE(world_position)
WRITE(last_cut)
WRITE(cut)
WRITE(contact_list)
WRITE(step_parts)
WRITE(body_motion)
WRITE(room)
WRITE(cluster)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, from_half)
PARAMETER(double, sleep_speed)  // [m/s] bodies sleep that have been so slow for long; 0: none does
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(uint, contact_capacity)
#include "parts/full_lists.glsl"
#include "parts/flight.glsl"
#include "parts/cut_before.glsl"
#include "parts/stays.glsl"
#include "parts/place.glsl"
#include "parts/rouse.glsl"
#include "parts/is_left_alone.glsl"
#include "parts/kept_surplus.glsl"

double part_left(uint i, uint b) {
  if (all_stay() || (flight_was_stopped(b) && !goes_on_alone(i, b))) return double(0);
  return double(uintBitsToFloat(cut_before(i, cut_rounds)));
}

void cut_short(uint i, uint b, double part, dvec3 gone) {
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  dvec3 rest = dvec3(vec3(rest_position[i])), first = LOAD3(motion, displacement_of(before));
  bool keeps_place = all_stay() || flight_was_stopped(b);
  dvec3 together = keeps_place ? dvec3(0) : rotate_back(pose[b], flight_in_step(b, to_world(pose[b], rest + first)));
  dvec3 displacement = first + together + part * (gone - together);
  STORE3(motion, displacement_of(after), displacement)
  world_position[after] = part == double(0) && together == dvec3(0)
                              ? world_position[before]
                              : vec4(vec3(to_world(pose[b], rest + displacement)), 1);
  for (uint k = 0u; k < 3u; ++k)
    place(start_slot, i, k, body[b].inverse_unit, double(rest_position[i][int(k)]), displacement[int(k)] - pose[b].reference[k]);
  cut[i] = floatBitsToUint(float(part));
  ATOMIC_STORE(contact_list[0].has_dues, 1u);
  ATOMIC_STORE(status[b].force_stale, 1u);
  ATOMIC_STORE(cluster[b].is_stirred, 1u);
  rouse(b);
  atomicAdd(control[0].count[reverted_vertices], 1u);
}

void end_step_part(bool is_made) {
  StepParts p = step_parts[0];
  if (is_made) end_part(p, control[0].time_step);
  if (is_made && all_stay()) p.held += 1u;
  p.longest = no_bound;
  step_parts[0] = p;
}

// Empties what the next step adds to, and counts this one.
void prepare_next_step(uint i, uint b) {
  if (i == 0u) {
    contact_list[0].fastest = contact_list[0].heaviest = 0u;
    bool was_made = control[0].time_step > double(0);
    if (contact_list[0].is_tried != 0u) contact_list[0].latest_count = was_made && !lists_are_full() ? contact_list[0].contact_count : 0u;
    end_step_part(control[0].non_finite_step == 0u && was_made);
  }
  if (i != body[b].first_vertex) return;
  if ((contact_list[0].arrivals & waited_in_vain) != 0u) status[b].activity = halted_waiting;
  room[b].to_others = no_bound;
  for (uint k = 0u; k < 3u; ++k) {
    body_motion[b].lower[k] = 0xffffffffu;
    body_motion[b].upper[k] = 0u;
    room[b].least_push[k] = room[b].most_push[k] = ordered_bits(0.0f);
  }
}

void keep_surplus(uint i, uint b, dvec3 at_start, dvec3 mean, dvec3 at_end) {
  if (!tells_of_surplus(control[0].time_step, contact_list[0].last_part)) return;
  dvec3 of_start = rotate(pose[b], mean - at_start), of_end = rotate(pose[b], at_end - mean);
  for (uint k = 0u; k < 3u; ++k)
    store_surplus(i, k, kept_surplus_after(kept_surplus(i, k), of_start[int(k)], of_end[int(k)], control[0].time_step));
}

// A scripted body goes whole, or it waits where it is. Its velocity is then still that of its path.
void settle_scripted(uint i, uint b, uint before, uint after) {
  if (control[0].time_step == double(0)) return;
  if (stays(b)) {
    STORE3(motion, displacement_of(after), LOAD3(motion, displacement_of(before)))
    STORE3(motion, velocity_of(after), LOAD3(motion, velocity_of(before)))
    world_position[after] = world_position[before];
  }
  last_cut[i] = stays(b) ? 1u : 0u;
  dvec3 gone = LOAD3(motion, displacement_of(after)) - LOAD3(motion, displacement_of(before));
  keep_surplus(i, b, LOAD3(motion, velocity_of(before)), gone / control[0].time_step, LOAD3(motion, velocity_of(after)));
}

void settle(uint i) {
  uint b = uint(rest_position[i].w);
  prepare_next_step(i, b);
  if ((status[b].activity != moving && status[b].activity != scripted) || is_left_alone(b)) return;
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  if (status[b].activity == scripted) {
    settle_scripted(i, b, before, after);
    return;
  }
  dvec3 gone = LOAD3(motion, displacement_of(after)) - LOAD3(motion, displacement_of(before));
  double most = most_tremble_ratio * sleep_speed * control[0].time_step;
  if (sleep_speed > double(0) && length(gone) > most) ATOMIC_STORE(cluster[b].is_stirred, 1u);
  dvec3 at_start = LOAD3(motion, velocity_of(before)), at_end = LOAD3(motion, velocity_of(after));
  // what sleeps on keeps what it fell asleep with. Whether it does is not asked of its status, because cuts of this pass may rouse it
  bool is_moved = gone != dvec3(0) || at_start != dvec3(0) || at_end != dvec3(0);
  if (is_moved || status[b].asleep == 0u) keep_surplus(i, b, at_start, gone / control[0].time_step, at_end);
  double part = part_left(i, b);
  last_cut[i] = part < double(1) ? 1u : 0u;
  if (part < double(1)) cut_short(i, b, part, gone);
}
