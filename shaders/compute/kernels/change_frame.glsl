// One thread a vertex, where a body's frame has turned: restates both halves' motions, the kept force and the placement in the new
// frame. World positions stay as stored.
#include "../physics/body.glsl"
READ(body)
READ(frame)
READ(rest_position)
WRITE(placement)
WRITE(kept_force)
WRITE(motion)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
#include "parts/place.glsl"

dvec3 turned(uint b, dvec3 p) {
  return dvec3(row_times(frame[b].turn[0], frame[b].turn[1], frame[b].turn[2], p),
               row_times(frame[b].turn[3], frame[b].turn[4], frame[b].turn[5], p),
               row_times(frame[b].turn[6], frame[b].turn[7], frame[b].turn[8], p));
}

void change_frame(uint i) {
  uint b = uint(rest_position[i].w);
  if (frame[b].turned == 0u) return;
  dvec3 rest = dvec3(vec3(rest_position[i]));
  for (uint half_index = 0u; half_index < 2u; ++half_index) {
    uint at = 6u * (half_index * vertex_count + i);
    dvec3 displacement = turned(b, rest + LOAD3(motion, at)) - rest - LOAD3(frame[b].shift, 0u);
    dvec3 velocity = turned(b, LOAD3(motion, at + 3u));
    STORE3(motion, at, displacement)
    STORE3(motion, at + 3u, velocity)
    if (half_index == from_half) continue;
    dvec3 relative = displacement - LOAD3(frame[b].reference, 0u);
    for (uint k = 0u; k < 3u; ++k) place(start_slot, i, k, body[b].inverse_unit, rest[int(k)], relative[int(k)]);
  }
  dvec3 kept = turned(b, LOAD3(kept_force, 3u * i));
  STORE3(kept_force, 3u * i, kept)
}
