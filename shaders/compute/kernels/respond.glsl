// One thread a vertex, where any triangles touch: a vertex in contact goes back to where the step began, bit for bit, and its
// velocity is reversed and scaled (the paper's response).
#include "../physics/body.glsl"
#include "../physics/control.glsl"
WRITE(0, Controls, Control, control)
READ(1, RestPositions, vec4, rest_position)
READ(2, Marks, uint, mark)
WRITE(3, Frames, Frame, frame)
WRITE(4, Motions, double, motion)
WRITE(5, WorldPositions, vec4, world_position)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)
PARAMETER(2, double, elasticity)

void respond(uint i) {
  if (i >= vertex_count || mark[i] != control[0].step) return;
  uint before = from_half * vertex_count + i;
  uint after = (1u - from_half) * vertex_count + i;
  dvec3 displacement = LOAD3(motion, 6u * before);
  dvec3 velocity = -elasticity * LOAD3(motion, 6u * after + 3u);
  STORE3(motion, 6u * after, displacement)
  STORE3(motion, 6u * after + 3u, velocity)
  world_position[after] = world_position[before];
  ATOMIC_STORE(frame[uint(rest_position[i].w)].force_stale, 1u);
  atomicAdd(control[0].count[reverted_vertices], 1u);
}
