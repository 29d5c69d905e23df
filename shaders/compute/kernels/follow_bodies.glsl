// One thread serves one body at the step's end. It stops the run at a number that is not finite. It also decides whether the body's
// frame follows the body's rotation.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/rotation.glsl"
WRITE(control)
READ(body)
WRITE(pose)
WRITE(frame_change)
WRITE(body_box)
WRITE(place_box)
WRITE(status)
WRITE(tally)
WRITE(meeting)
WRITE(slept)
READ(rest_position)
READ(motion)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(uint, body_count)
PARAMETER(uint, skips)
PARAMETER(uint, forces_of_a_step)
void count_frame_change(uint b) { tally[b].frame_changes += 1u; }
#include "parts/follow_rotation.glsl"

uint sample_of(IN(Body) material, uint k) { return sample_vertex(material.first_vertex, material.vertex_count, k); }
dvec3 sample_rest(IN(Body) material, uint k) { return dvec3(vec3(rest_position[sample_of(material, k)])); }
dvec3 sample_displacement(IN(Body) material, uint k) {
  return LOAD3(motion, displacement_of(in_half(other_half(from_half), vertex_count, sample_of(material, k))));
}

dvec3 moved_sample(dvec3 rest, dvec3 displacement, dvec3 origin) {
  return dvec3(place_of_sample(rest.x, displacement.x, origin.x), place_of_sample(rest.y, displacement.y, origin.y),
               place_of_sample(rest.z, displacement.z, origin.z));
}

// Adds a sample. `moved` is relative to a point that moves with the body.
void add_sample(INOUT(Samples) s, dvec3 rest, dvec3 moved) {
  EXACT dvec3 rest_sum = s.rest_mean + rest;
  EXACT dvec3 moved_sum = s.moved_mean + moved;
  EXACT dvec3 by_x = s.correlation_x + rest.x * moved;
  EXACT dvec3 by_y = s.correlation_y + rest.y * moved;
  EXACT dvec3 by_z = s.correlation_z + rest.z * moved;
  s.rest_mean = rest_sum;
  s.moved_mean = moved_sum;
  s.correlation_x = by_x;
  s.correlation_y = by_y;
  s.correlation_z = by_z;
}

// Adds four samples, from k on. There is no loop, so that loads overlap.
void add_samples(INOUT(Samples) s, IN(Body) material, uint k, dvec3 origin) {
  dvec3 r0 = sample_rest(material, k), r1 = sample_rest(material, k + 1u), r2 = sample_rest(material, k + 2u),
        r3 = sample_rest(material, k + 3u);
  dvec3 u0 = sample_displacement(material, k), u1 = sample_displacement(material, k + 1u), u2 = sample_displacement(material, k + 2u),
        u3 = sample_displacement(material, k + 3u);
  add_sample(s, r0, moved_sample(r0, u0, origin));
  add_sample(s, r1, moved_sample(r1, u1, origin));
  add_sample(s, r2, moved_sample(r2, u2, origin));
  add_sample(s, r3, moved_sample(r3, u3, origin));
}

Samples take_samples(IN(Body) material, dvec3 origin) {
  Samples s;
  s.rest_mean = s.moved_mean = s.correlation_x = s.correlation_y = s.correlation_z = dvec3(0);
  add_samples(s, material, 0u, origin);
  add_samples(s, material, 4u, origin);
  add_samples(s, material, 8u, origin);
  add_samples(s, material, 12u, origin);
  return about_means(s);
}

// Whether the step left the body where it was, and the next one will, too. In a body that is not deformed all vertices move alike. Of a
// scripted one end_paths has found it.
bool is_left_where_it_was(uint b) {
  if (status[b].activity == scripted) return status[b].disturbed == 0u;
  if (status[b].activity == immovable || is_asleep(status[b])) return true;
  uint first = body[b].first_vertex;
  uint before = in_half(from_half, vertex_count, first), after = in_half(other_half(from_half), vertex_count, first);
  return status[b].deformed == 0u && LOAD3(pose[b].gravity, 0u) == dvec3(0) &&
         LOAD3(motion, displacement_of(before)) == LOAD3(motion, displacement_of(after)) &&
         LOAD3(motion, velocity_of(before)) == dvec3(0) && LOAD3(motion, velocity_of(after)) == dvec3(0);
}

#include "parts/note_step_asleep.glsl"

// What the body loses as it falls asleep: its velocity, summed over vertices.
void note_motion(uint b) {
  dvec3 sum = dvec3(0);
  double squares = double(0);
  for (uint i = body[b].first_vertex; i < body[b].first_vertex + body[b].vertex_count; ++i) {
    dvec3 velocity = LOAD3(motion, velocity_of(in_half(other_half(from_half), vertex_count, i)));
    sum += velocity;
    squares += dot(velocity, velocity);
  }
  slept[energy_slept_of(b)] += squares / (double(2) * body[b].inverse_mass);
  note_momentum(b, sum);
}

void count_calm_steps(uint b) {
  if (status[b].calm >= at_rest && status[b].asleep == 0u && status[b].disturbed == 0u) tally[b].steps_at_rest += 1u;
  if (is_still(status[b]) && status[b].activity == moving) tally[b].forces_skipped += forces_of_a_step;
  if (status[b].activity == moving || status[b].activity == immovable || status[b].activity == scripted) {
    uint most = status[b].disturbed == 0u && (skips & skips_rest) != 0u ? at_rest : quiet;
    status[b].calm = is_left_where_it_was(b) ? min(status[b].calm + 1u, most) : 0u;
  } else if (status[b].disturbed != 0u) {
    status[b].calm = min(status[b].calm, quiet);  // what a step that was undone found of it does not stand
  }
  if (is_asleep(status[b]) && status[b].activity == moving) note_step_asleep(b);
  if (status[b].falls_asleep != 0u) status[b].calm = forgotten;
  status[b].disturbed = 0u;
}

// Empties what the next step adds to. The search has been through the boxes, and all groups have met.
void prepare_next_step(uint b) {
  for (uint k = 0u; k < 3u && status[b].calm != at_rest; ++k) {
    body_box[b].lower[k] = place_box[b].lower[k] = 0xffffffffu;
    body_box[b].upper[k] = place_box[b].upper[k] = 0u;
  }
  status[b].steps_to_star = status[b].folds != 0u ? steps_after_no_star : max(status[b].steps_to_star, 1u) - 1u;
  status[b].first_pair = status[b].folds = 0u;
  if (status[b].falls_asleep != 0u) note_motion(b);
  frame_change[b].turned = 0u;
  meeting[b] = 0u;
}

// Tells the first vertex of all bodies that is not finite, if there is one.
void tell_non_finite() {
  uint first = status[body_count].non_finite_vertex;
  if (first != no_vertex && control[0].non_finite_step == 0u) control[0].non_finite_vertex = first;
}

void follow_bodies(uint b) {
  dvec3 origin = LOAD3(pose[b].reference, 0u);
  Samples samples = take_samples(body[b], origin);  // before it is known whether they are needed: waiting costs more
  count_calm_steps(b);
  prepare_next_step(b);
  if (b == 0u) tell_non_finite();
  if (status[b].activity != moving && status[b].activity != scripted) return;
  if (status[body_count].non_finite_vertex != no_vertex)
    status[b].activity = halted_for_good;
  else
    follow_rotation(b, body[b].first_vertex, samples, origin);
}
