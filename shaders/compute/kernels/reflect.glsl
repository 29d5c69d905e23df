// One thread serves one vertex. It follows the body's frame. A vertex in contact goes back to where the step began, bit for bit. Its
// velocity is reversed and scaled. This is the paper's response.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
WRITE(control)
READ(body)
READ(pose)
READ(frame_change)
WRITE(status)
READ(rest_position)
READ(mark)
WRITE(placement)
WRITE(kept_force)
WRITE(motion)
WRITE(world_position)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(double, elasticity)
#include "parts/place.glsl"
#include "parts/follow_frame.glsl"
#include "parts/rouse.glsl"

void reflect(uint i) {
  uint b = uint(rest_position[i].w);
  follow_frame(i, b);
  if (mark[i] != control[0].step) return;
  if (status[b].activity != moving) return;
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  dvec3 displacement = LOAD3(motion, displacement_of(before));
  dvec3 velocity = -elasticity * LOAD3(motion, velocity_of(after));
  STORE3(motion, displacement_of(after), displacement)
  STORE3(motion, velocity_of(after), velocity)
  world_position[after] = world_position[before];
  for (uint k = 0u; k < 3u; ++k)
    place(start_slot, i, k, body[b].inverse_unit, double(rest_position[i][int(k)]), displacement[int(k)] - pose[b].reference[k]);
  ATOMIC_STORE(status[b].force_stale, 1u);
  rouse(b);
  atomicAdd(control[0].count[reverted_vertices], 1u);
}
