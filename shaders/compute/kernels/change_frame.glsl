// One thread serves one vertex. It follows the body's frame. A body that falls asleep ends in both halves where it is, without motion.
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
#include "parts/follow_frame.glsl"

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
  follow_frame(i, b);
  if (status[b].falls_asleep == 0u) return;
  fall_asleep(i);
  if (i == body[b].first_vertex) status[b].asleep = 1u;
}
