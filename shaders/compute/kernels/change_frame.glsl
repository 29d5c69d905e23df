// One thread serves one vertex. If the body's frame has turned, it restates the motion of both halves, the kept force and the placement
// in the new frame. World positions stay as stored. A body that falls asleep ends in both halves where it is, without motion.
#include "../physics/body.glsl"
#include "../physics/layout.glsl"
READ(body)
READ(pose)
READ(frame_change)
READ(rest_position)
WRITE(placement)
WRITE(kept_force)
WRITE(motion)
WRITE(status)
WRITE(world_position)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
#include "parts/place.glsl"

dvec3 turned(uint b, dvec3 p) {
  return dvec3(row_times(frame_change[b].turn[0], frame_change[b].turn[1], frame_change[b].turn[2], p),
               row_times(frame_change[b].turn[3], frame_change[b].turn[4], frame_change[b].turn[5], p),
               row_times(frame_change[b].turn[6], frame_change[b].turn[7], frame_change[b].turn[8], p));
}

void fall_asleep(uint i) {
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  dvec3 displacement = LOAD3(motion, displacement_of(after));
  STORE3(motion, displacement_of(before), displacement)
  STORE3(motion, velocity_of(before), dvec3(0))
  STORE3(motion, velocity_of(after), dvec3(0))
  world_position[before] = world_position[after];
}

void restate(uint i, uint b) {
  dvec3 rest = dvec3(vec3(rest_position[i]));
  for (uint half_index = 0u; half_index < 2u; ++half_index) {
    uint at = in_half(half_index, vertex_count, i), u = displacement_of(at), w = velocity_of(at);
    dvec3 displacement = turned(b, rest + LOAD3(motion, u)) - rest - LOAD3(frame_change[b].shift, 0u);
    dvec3 velocity = turned(b, LOAD3(motion, w));
    STORE3(motion, u, displacement)
    STORE3(motion, w, velocity)
    if (half_index == from_half) continue;
    dvec3 relative = displacement - LOAD3(pose[b].reference, 0u);
    for (uint k = 0u; k < 3u; ++k) place(start_slot, i, k, body[b].inverse_unit, rest[int(k)], relative[int(k)]);
  }
  dvec3 kept = turned(b, LOAD3(kept_force, force_of(i)));
  STORE3(kept_force, force_of(i), kept)
}

void change_frame(uint i) {
  uint b = uint(rest_position[i].w);
  if (frame_change[b].turned != 0u) restate(i, b);
  if (status[b].falls_asleep == 0u) return;
  fall_asleep(i);
  if (i == body[b].first_vertex) status[b].asleep = 1u;
}
