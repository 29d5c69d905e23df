// One thread a vertex, first in a step of a splitting method: kick by the kept force, then drift.
#include "../physics/body.glsl"
#include "../physics/damping.glsl"
READ(0, Bodies, Body, body)
READ(1, Frames, Frame, frame)
READ(2, RestPositions, vec4, rest_position)
WRITE(3, Stages, real4, stage)
READ(4, Forces, real4, force)
WRITE(5, Motions, double, motion)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)
PARAMETER(2, uint, damping_law)
PARAMETER(3, double, kick_time)   // [s]
PARAMETER(4, double, drift_time)  // [s]
#include "parts/kick.glsl"

void first_kick(uint i) {
  uint b = uint(rest_position[i].w);
  if (frame[b].halted != 0u) return;
  uint before = 6u * (from_half * vertex_count + i);
  uint after = 6u * ((1u - from_half) * vertex_count + i);
  uint reference = 6u * (from_half * vertex_count + body[b].first_vertex);
  dvec3 u = LOAD3(motion, before);
  dvec3 w = kicked(b, real3(force[i]), LOAD3(motion, before + 3u), kick_time);
  dvec3 relative = (u - LOAD3(motion, reference)) + drift_time * (w - LOAD3(motion, reference + 3u));
  dvec3 drifted = u + drift_time * w;
  stage[i] = real4(real3(relative), 0);
  STORE3(motion, after, drifted)
  STORE3(motion, after + 3u, w)
}
