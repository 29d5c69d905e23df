// One thread a vertex: a vertex in contact goes back to where the step began, bit for bit, and its velocity is reversed and
// scaled (the paper's response).
#include "../physics/body.glsl"
#include "../physics/control.glsl"
WRITE(control)
READ(body)
WRITE(frame)
READ(rest_position)
READ(mark)
WRITE(placement)
WRITE(motion)
WRITE(world_position)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(double, elasticity)
#include "parts/place.glsl"

void respond(uint i) {
  if (mark[i] != control[0].step) return;
  uint b = uint(rest_position[i].w);
  if (frame[b].halted != not_halted) return;
  uint before = from_half * vertex_count + i;
  uint after = (1u - from_half) * vertex_count + i;
  dvec3 displacement = LOAD3(motion, 6u * before);
  dvec3 velocity = -elasticity * LOAD3(motion, 6u * after + 3u);
  STORE3(motion, 6u * after, displacement)
  STORE3(motion, 6u * after + 3u, velocity)
  world_position[after] = world_position[before];
  for (uint k = 0u; k < 3u; ++k)
    place(start_slot, i, k, body[b].inverse_unit, double(rest_position[i][int(k)]), displacement[int(k)] - frame[b].reference[k]);
  ATOMIC_STORE(frame[b].force_stale, 1u);
  ATOMIC_STORE(frame[b].deformed, 1u);
  atomicAdd(control[0].count[reverted_vertices], 1u);
}
