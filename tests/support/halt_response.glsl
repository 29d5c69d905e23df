// A response of the tests' own. One thread serves one vertex. A vertex that touches another body goes back to where the step began, and
// stands still.
#include "physics/body.glsl"
#include "physics/control.glsl"
#include "physics/layout.glsl"
WRITE(control)
READ(body)
READ(pose)
WRITE(status)
READ(rest_position)
READ(mark)
WRITE(placement)
WRITE(motion)
WRITE(world_position)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
#include "kernels/parts/place.glsl"

void halt_response(uint i) {
  uint b = uint(rest_position[i].w);
  if (mark[i] != control[0].step || status[b].activity != moving) return;
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  dvec3 displacement = LOAD3(motion, displacement_of(before));
  STORE3(motion, displacement_of(after), displacement)
  STORE3(motion, velocity_of(after), dvec3(0))
  world_position[after] = world_position[before];
  for (uint k = 0u; k < 3u; ++k)
    place(start_slot, i, k, body[b].inverse_unit, double(rest_position[i][int(k)]), displacement[int(k)] - pose[b].reference[k]);
  ATOMIC_STORE(status[b].force_stale, 1u);
  ATOMIC_STORE(status[b].deformed, 1u);
  atomicAdd(control[0].count[reverted_vertices], 1u);
}
