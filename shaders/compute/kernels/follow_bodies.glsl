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
PARAMETER(uint, skips)  // 1: bodies at rest are left alone
PARAMETER(uint, forces_of_a_step)

// Of the vertices that stand for the body, because any rotation near its own is good enough: their rest positions, and where they are in
// the frame, relative to a point that moves with the body.
struct Samples {
  dvec3 rest_mean;
  dvec3 moved_mean;
  dvec3 correlation_x;  // sum of (moved - moved_mean) (rest - rest_mean).x, in the next two with .y and .z
  dvec3 correlation_y;
  dvec3 correlation_z;
};

uint sample_of(uint b, uint k) { return sample_vertex(body[b].first_vertex, body[b].vertex_count, k); }
dvec3 sample_rest(uint b, uint k) { return dvec3(vec3(rest_position[sample_of(b, k)])); }
dvec3 sample_displacement(uint b, uint k) {
  return LOAD3(motion, displacement_of(in_half(other_half(from_half), vertex_count, sample_of(b, k))));
}

// Adds a sample. `moved` is relative to a point that moves with the body. take_samples() subtracts the means.
void add_sample(INOUT(Samples) s, dvec3 rest, dvec3 moved) {
  s.rest_mean += rest;
  s.moved_mean += moved;
  s.correlation_x += rest.x * moved;
  s.correlation_y += rest.y * moved;
  s.correlation_z += rest.z * moved;
}

// Adds four samples, from k on. There is no loop, so that loads overlap.
void add_samples(INOUT(Samples) s, uint b, uint k, dvec3 origin) {
  dvec3 r0 = sample_rest(b, k), r1 = sample_rest(b, k + 1u), r2 = sample_rest(b, k + 2u), r3 = sample_rest(b, k + 3u);
  dvec3 u0 = sample_displacement(b, k), u1 = sample_displacement(b, k + 1u), u2 = sample_displacement(b, k + 2u),
        u3 = sample_displacement(b, k + 3u);
  add_sample(s, r0, r0 + (u0 - origin));
  add_sample(s, r1, r1 + (u1 - origin));
  add_sample(s, r2, r2 + (u2 - origin));
  add_sample(s, r3, r3 + (u3 - origin));
}

Samples take_samples(uint b, dvec3 origin) {
  Samples s;
  s.rest_mean = s.moved_mean = s.correlation_x = s.correlation_y = s.correlation_z = dvec3(0);
  add_samples(s, b, 0u, origin);
  add_samples(s, b, 4u, origin);
  add_samples(s, b, 8u, origin);
  add_samples(s, b, 12u, origin);
  s.rest_mean /= double(sample_count);
  s.correlation_x -= s.rest_mean.x * s.moved_mean;
  s.correlation_y -= s.rest_mean.y * s.moved_mean;
  s.correlation_z -= s.rest_mean.z * s.moved_mean;
  s.moved_mean /= double(sample_count);
  return s;
}

// Returns the turn [rad] that reduces the samples' misfit to the rest shape turned by q. The method is from Mueller and others (2016),
// "A robust method to extract the rotational part of deformations".
dvec3 remaining_turn(IN(Samples) s, Quaternion q) {
  dvec3 x = rotate_by(q, dvec3(1, 0, 0)), y = rotate_by(q, dvec3(0, 1, 0)), z = rotate_by(q, dvec3(0, 0, 1));
  dvec3 torque = cross(x, s.correlation_x) + cross(y, s.correlation_y) + cross(z, s.correlation_z);
  double alignment = dot(x, s.correlation_x) + dot(y, s.correlation_y) + dot(z, s.correlation_z);
  return torque / (abs(alignment) + double(1e-30));
}

void change_frame_of(uint b, Quaternion q, dvec3 rest_mean, dvec3 moved_mean) {
  Quaternion old = quaternion(pose[b].quaternion[0], pose[b].quaternion[1], pose[b].quaternion[2], pose[b].quaternion[3]);
  Quaternion next = normalized(product(old, q));
  Quaternion back = conjugate(q);
  dvec3 shift = rotate_by(back, moved_mean) - rest_mean;
  dvec3 origin = LOAD3(pose[b].origin, 0u) + rotate_by(next, shift);
  dvec3 gravity = rotate_by(back, LOAD3(pose[b].gravity, 0u));
  STORE3(pose[b].origin, 0u, origin)
  STORE3(frame_change[b].shift, 0u, shift)
  STORE3(pose[b].gravity, 0u, gravity)
  pose[b].quaternion[0] = next.x;
  pose[b].quaternion[1] = next.y;
  pose[b].quaternion[2] = next.z;
  pose[b].quaternion[3] = next.w;
  for (uint column = 0u; column < 3u; ++column) {
    dvec3 unit = dvec3(double(column == 0u), double(column == 1u), double(column == 2u));
    dvec3 r = rotate_by(next, unit);
    dvec3 t = rotate_by(back, unit);
    pose[b].rotation[column] = r.x;
    pose[b].rotation[3u + column] = r.y;
    pose[b].rotation[6u + column] = r.z;
    frame_change[b].turn[column] = t.x;
    frame_change[b].turn[3u + column] = t.y;
    frame_change[b].turn[6u + column] = t.z;
  }
  dvec3 first = dvec3(vec3(rest_position[body[b].first_vertex]));
  dvec3 reference = rotate_by(back, first + LOAD3(pose[b].reference, 0u)) - first - shift;
  STORE3(pose[b].reference, 0u, reference)
  frame_change[b].turned = 1u;
  tally[b].frame_changes += 1u;
}

// The frame follows once the body has turned by more than 0.01 rad in it. Displacements then stay small against the body,
// and their rounding to fp32 small against the strains.
void follow_rotation(uint b, IN(Samples) samples, dvec3 origin) {
  const double largest_turn = double(0.01), smallest_turn = double(1e-9);
  Quaternion q = quaternion(double(0), double(0), double(0), double(1));
  dvec3 turn = remaining_turn(samples, q);
  if (!(dot(turn, turn) > largest_turn * largest_turn)) return;
  for (uint iteration = 0u; iteration < 8u && dot(turn, turn) > smallest_turn * smallest_turn; ++iteration) {
    Quaternion small = quaternion(turn.x / double(2), turn.y / double(2), turn.z / double(2), double(1));
    q = normalized(product(small, q));
    turn = remaining_turn(samples, q);
  }
  change_frame_of(b, q, samples.rest_mean, samples.moved_mean + origin);
}

// Whether the step left the body where it was, and the next one will, too. In a body that is not deformed all vertices move alike.
bool is_left_where_it_was(uint b) {
  if (status[b].activity == immovable || is_asleep(status[b])) return true;
  uint first = body[b].first_vertex;
  uint before = in_half(from_half, vertex_count, first), after = in_half(other_half(from_half), vertex_count, first);
  return status[b].deformed == 0u && LOAD3(pose[b].gravity, 0u) == dvec3(0) &&
         LOAD3(motion, displacement_of(before)) == LOAD3(motion, displacement_of(after)) &&
         LOAD3(motion, velocity_of(before)) == dvec3(0) && LOAD3(motion, velocity_of(after)) == dvec3(0);
}

// What bears the body takes the momentum of this velocity in the frame, which is summed over vertices.
void note_momentum(uint b, dvec3 velocity) {
  dvec3 in_world = dvec3(row_times(pose[b].rotation[0], pose[b].rotation[1], pose[b].rotation[2], velocity),
                         row_times(pose[b].rotation[3], pose[b].rotation[4], pose[b].rotation[5], velocity),
                         row_times(pose[b].rotation[6], pose[b].rotation[7], pose[b].rotation[8], velocity));
  dvec3 taken = LOAD3(slept, momentum_slept_of(b)) + in_world / body[b].inverse_mass;
  STORE3(slept, momentum_slept_of(b), taken)
}

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

// What bears the body takes what gravity would give it in the step.
void note_step_asleep(uint b) {
  tally[b].steps_asleep += 1u;
  note_momentum(b, (double(body[b].vertex_count) * control[0].time_step) * LOAD3(pose[b].gravity, 0u));
}

void count_calm_steps(uint b) {
  if (status[b].calm >= at_rest && status[b].asleep == 0u && status[b].disturbed == 0u) tally[b].steps_at_rest += 1u;
  if (is_still(status[b]) && status[b].activity == moving) tally[b].forces_skipped += forces_of_a_step;
  if (status[b].activity == moving || status[b].activity == immovable) {
    uint most = status[b].disturbed == 0u && skips != 0u ? at_rest : quiet;
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
  status[b].first_pair = 0u;
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
  Samples samples = take_samples(b, origin);  // before it is known whether they are needed: waiting costs more
  count_calm_steps(b);
  prepare_next_step(b);
  if (b == 0u) tell_non_finite();
  if (status[b].activity != moving) return;
  if (status[body_count].non_finite_vertex != no_vertex)
    status[b].activity = halted_for_good;
  else
    follow_rotation(b, samples, origin);
}
