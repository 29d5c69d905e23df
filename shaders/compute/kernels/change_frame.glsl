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
PARAMETER(uint, keeps_force)  // 1: the method keeps spring forces for the next step
#include "parts/place.glsl"
#include "parts/restate.glsl"
#include "parts/restate_force.glsl"

void fall_asleep(uint i) {
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  dvec3 displacement = LOAD3(motion, displacement_of(after));
  STORE3(motion, displacement_of(before), displacement)
  STORE3(motion, velocity_of(before), dvec3(0))
  STORE3(motion, velocity_of(after), dvec3(0))
  world_position[before] = world_position[after];
}

void change_frame(uint i) {
  uint b = uint(rest_position[i].w);
  if (frame_change[b].turned != 0u) restate(i, b, body[b].inverse_unit);
  if (frame_change[b].turned != 0u && keeps_force != 0u) restate_force(i, b);
  if (status[b].falls_asleep == 0u) return;
  fall_asleep(i);
  if (i == body[b].first_vertex) status[b].asleep = 1u;
}
