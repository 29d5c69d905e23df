// One thread a vertex: sums the spring forces again where a contact has moved vertices since they were kept.
#include "../physics/body.glsl"
#include "../physics/forces/spring.glsl"
READ(0, Bodies, Body, body)
WRITE(1, Frames, Frame, frame)
READ(2, RestPositions, vec4, rest_position)
READ(3, Stages, real4, stage)
WRITE(4, Forces, real4, force)
PARAMETER(0, uint, vertex_count)
#include "parts/net_force.glsl"

void refresh_force(uint i) {
  if (i >= vertex_count) return;
  uint b = uint(rest_position[i].w);
  if (frame[b].halted != 0u || frame[b].refresh_force == 0u) return;
  force[i] = real4(body_spring_force(i, b, 0u), 0);
}
