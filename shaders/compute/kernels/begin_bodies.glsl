// One thread a body, first in a step: clears what the step gathers, and decides whether the body's frame follows its rotation.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/rotation.glsl"
WRITE(0, Controls, Control, control)
READ(1, Bodies, Body, body)
WRITE(2, Frames, Frame, frame)
READ(3, RestPositions, vec4, rest_position)
READ(4, Motions, double, motion)
WRITE(5, BodyBoxes, uint, body_box)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)

// Sixteen vertices, evenly spaced in the body's list, stand for it: any rotation near the body's own is good enough.
const uint sample_count = 16u;

uint sample_vertex(uint b, uint k) {
  return body[b].first_vertex + uint(double(k) / double(sample_count) * double(body[b].vertex_count));
}

dvec3 sample_rest(uint b, uint k) { return dvec3(vec3(rest_position[sample_vertex(b, k)])); }

dvec3 sample_displacement(uint b, uint k) {
  return LOAD3(motion, 6u * (from_half * vertex_count + sample_vertex(b, k)));
}

// Mueller and others (2016), "A robust method to extract the rotational part of deformations": the turn that reduces the
// samples' misfit to the rest shape turned by q.
dvec3 remaining_turn(uint b, Quaternion q, dvec3 rest_mean, dvec3 moved_mean) {
  dvec3 torque = dvec3(0);
  double alignment = double(0);
  for (uint k = 0u; k < sample_count; ++k) {
    dvec3 rest = sample_rest(b, k);
    dvec3 turned = rotate_by(q, rest - rest_mean);
    dvec3 moved = rest + sample_displacement(b, k) - moved_mean;
    torque += cross(turned, moved);
    alignment += dot(turned, moved);
  }
  return torque / (abs(alignment) + double(1e-30));
}

void change_frame_of(uint b, Quaternion q, dvec3 rest_mean, dvec3 moved_mean) {
  Quaternion old = quaternion(frame[b].quaternion[0], frame[b].quaternion[1], frame[b].quaternion[2], frame[b].quaternion[3]);
  Quaternion next = normalized(product(old, q));
  Quaternion back = conjugate(q);
  dvec3 shift = rotate_by(back, moved_mean) - rest_mean;
  dvec3 origin = LOAD3(frame[b].origin, 0u) + rotate_by(next, shift);
  dvec3 gravity = rotate_by(back, LOAD3(frame[b].gravity, 0u));
  STORE3(frame[b].origin, 0u, origin)
  STORE3(frame[b].shift, 0u, shift)
  STORE3(frame[b].gravity, 0u, gravity)
  frame[b].quaternion[0] = next.x;
  frame[b].quaternion[1] = next.y;
  frame[b].quaternion[2] = next.z;
  frame[b].quaternion[3] = next.w;
  for (uint column = 0u; column < 3u; ++column) {
    dvec3 unit = dvec3(double(column == 0u), double(column == 1u), double(column == 2u));
    dvec3 r = rotate_by(next, unit);
    dvec3 t = rotate_by(back, unit);
    frame[b].rotation[column] = r.x;
    frame[b].rotation[3u + column] = r.y;
    frame[b].rotation[6u + column] = r.z;
    frame[b].turn[column] = t.x;
    frame[b].turn[3u + column] = t.y;
    frame[b].turn[6u + column] = t.z;
  }
  frame[b].turned = 1u;
  atomicAdd(control[0].count[frame_changes], 1u);
  atomicMax(control[0].turn_groups[0], groups_for(vertex_count));
}

// The frame follows once the body has turned by more than 0.01 rad in it. Displacements then stay small against the body,
// and their rounding to fp32 small against the strains.
void follow_rotation(uint b) {
  const double largest_turn = double(0.01);
  dvec3 rest_mean = dvec3(0);
  dvec3 moved_mean = dvec3(0);
  for (uint k = 0u; k < sample_count; ++k) {
    rest_mean += sample_rest(b, k) / double(sample_count);
    moved_mean += (sample_rest(b, k) + sample_displacement(b, k)) / double(sample_count);
  }
  Quaternion q = quaternion(double(0), double(0), double(0), double(1));
  dvec3 turn = remaining_turn(b, q, rest_mean, moved_mean);
  if (!(dot(turn, turn) > largest_turn * largest_turn)) return;
  for (uint iteration = 0u; iteration < 8u; ++iteration) {
    Quaternion small = quaternion(turn.x / double(2), turn.y / double(2), turn.z / double(2), double(1));
    q = normalized(product(small, q));
    turn = remaining_turn(b, q, rest_mean, moved_mean);
  }
  change_frame_of(b, q, rest_mean, moved_mean);
}

void begin_bodies(uint b) {
  for (uint k = 0u; k < 3u; ++k) {
    body_box[6u * b + k] = 0xffffffffu;
    body_box[6u * b + 3u + k] = 0u;
  }
  frame[b].halted = control[0].non_finite_step != 0u ? 1u : 0u;
  frame[b].turned = 0u;
  if (frame[b].halted != 0u) return;
  follow_rotation(b);
  frame[b].deformed = 0u;
  frame[b].refresh_force = frame[b].force_stale;
  frame[b].force_stale = 0u;
  if (frame[b].refresh_force != 0u) atomicMax(control[0].refresh_groups[0], groups_for(vertex_count));
}
