// One thread a vertex: the displacement at which the step's first forces are taken, rounded to the precision of the forces
// relative to the body's first vertex, so that a translation costs no digits. Finds out whether the body is deformed at all.
#include "../physics/body.glsl"
#include "../physics/damping.glsl"
READ(0, Bodies, Body, body)
WRITE(1, Frames, Frame, frame)
READ(2, RestPositions, vec4, rest_position)
READ(3, Motions, double, motion)
WRITE(4, Stages, real4, stage)
WRITE(5, Accelerations, double, acceleration)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)
PARAMETER(2, uint, keep_velocity)  // 1: the first stage's velocity goes where its acceleration will stand

void round_displacement(uint i) {
  uint b = uint(rest_position[i].w);
  uint at = 6u * (from_half * vertex_count + i);
  uint at_first = 6u * (from_half * vertex_count + body[b].first_vertex);
  dvec3 displacement = LOAD3(motion, at) - LOAD3(motion, at_first);
  dvec3 velocity = LOAD3(motion, at + 3u);
  stage[i] = real4(real3(displacement), 0);
  if (displacement != dvec3(0) || velocity != LOAD3(motion, at_first + 3u)) ATOMIC_STORE(frame[b].deformed, 1u);
  if (keep_velocity != 0u) STORE3(acceleration, 3u * i, velocity)
}
