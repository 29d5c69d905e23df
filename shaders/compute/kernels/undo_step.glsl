// One thread serves one vertex, after a step that is rejected or empty. It makes the state from before the state after, bit for bit.
// The body rests until the next step.
#include "../physics/body.glsl"
#include "../physics/layout.glsl"
#include "../physics/pace.glsl"
READ(pace)
READ(body)
WRITE(pose)
WRITE(status)
READ(rest_position)
WRITE(placement)
WRITE(motion)
WRITE(world_position)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, from_half)
#include "parts/place.glsl"

void rest_body(uint b) {
  for (uint k = 0u; k < 3u; ++k) pose[b].reference[k] = pose[b].start_reference[k];
  status[b].non_finite_vertex = no_vertex;
  if (status[b].activity == moving) status[b].activity = halted_for_now;
}

void undo_step(uint i) {
  if (pace[0].verdict != step_rejected && pace[0].verdict != step_empty) return;
  uint b = uint(rest_position[i].w);
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  for (uint k = 0u; k < motion_size; ++k) motion[displacement_of(after) + k] = motion[displacement_of(before) + k];
  world_position[after] = world_position[before];
  for (uint k = 0u; k < 3u; ++k)
    place(start_slot, i, k, body[b].inverse_unit, double(rest_position[i][int(k)]),
          motion[displacement_of(before) + k] - pose[b].start_reference[k]);
  if (i == body[b].first_vertex) rest_body(b);
  if (i == 0u) status[body_count].non_finite_vertex = no_vertex;
}
