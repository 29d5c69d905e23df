// One thread serves one vertex at a step's start. It finds where the vertex is and how it moves. It extends the boxes of its body's places
// and of its expected velocities.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/parts.glsl"
READ(control)
READ(body)
WRITE(step_parts)
READ(pose)
READ(rest_position)
READ(motion)
WRITE(surplus)
WRITE(start)
WRITE(unkicked_velocity)
WRITE(body_motion)
WRITE_AS(place_box, BoxBits, body_box)
WRITE(status)
WRITE(cluster)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, from_half)
PARAMETER(uint, may_undo_steps)  // 1: a tolerance may
PARAMETER(double, share_of_lead)
#include "parts/bound.glsl"

void leave_island(uint b) {
  if (b == 0u) cluster[body_count].has_company = 0u;
  cluster[b].island = b;
  cluster[b].has_company = 0u;
  cluster[b].is_disturbed = 0u;
  cluster[b].is_stirred = cluster[b].is_restless = cluster[b].is_borne = 0u;
  cluster[b].cannot_fly = status[b].activity == immovable ? 1u : 0u;
  if (!is_idle(status[b])) cluster[b].is_beside_static = 0u;
}

// What falls asleep loses its motion. The forces on it still act, so what is expected of them is kept for when it wakes. Bounds of its
// motion do not have that in the step that wakes it: as in a first step, reaches allow for forces (play_of() in reach.glsl).
void forget_end(uint i) {
  STORE3(surplus, end_surplus_of(vertex_count, i), real3(0))
  if (share_of_lead != double(0)) STORE3(surplus, surplus_lead_of(vertex_count, i), real3(0))
}

// All else that a step finds of a body at rest still stands.
void expect_rest(uint b) {
  for (uint k = 0u; k < 3u; ++k) body_motion[b].lower[k] = body_motion[b].upper[k] = ordered_bits(0.0f);
}

void measure_motion(uint i) {
  if (i == 0u && step_parts[0].divides == 0u) step_parts[0].full = control[0].time_step;
  uint b = uint(rest_position[i].w);
  if (i == body[b].first_vertex) leave_island(b);
  if (is_idle(status[b])) {
    if (i == body[b].first_vertex) expect_rest(b);
    return;
  }
  if (status[b].asleep != 0u) forget_end(i);
  uint at = in_half(from_half, vertex_count, i);
  dvec3 position = to_world(pose[b], dvec3(vec3(rest_position[i])) + LOAD3(motion, displacement_of(at)));
  dvec3 in_frame = LOAD3(motion, velocity_of(at)), velocity = rotate(pose[b], in_frame);
  STORE3(start, start_position_of(i), position)
  STORE3(start, start_velocity_of(i), velocity)
  if (may_undo_steps != 0u) STORE3(unkicked_velocity, force_of(i), in_frame)
  dvec3 mean = velocity;
  if (!is_asleep(status[b])) mean += step_parts[0].last * LOAD3(surplus, expected_surplus_of(i));  // limit_step has yet to find this length
  for (uint k = 0u; k < 3u; ++k) {
    bound(i, b, k, float(position[int(k)]));
    uint bits = ordered_bits(float(mean[int(k)]));
    LOWER_TO(body_motion[b].lower[k], bits)
    RAISE_TO(body_motion[b].upper[k], bits)
  }
}
