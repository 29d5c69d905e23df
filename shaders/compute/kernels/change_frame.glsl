// One thread a vertex, where a body's frame has turned: restates displacement, velocity and kept force in the new frame.
// World positions stay as stored.
#include "../physics/body.glsl"
READ(0, Frames, Frame, frame)
READ(1, RestPositions, vec4, rest_position)
WRITE(2, Motions, double, motion)
WRITE(3, Forces, real4, force)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)

dvec3 turned(uint b, dvec3 p) {
  return dvec3((frame[b].turn[0] * p.x + frame[b].turn[1] * p.y) + frame[b].turn[2] * p.z,
               (frame[b].turn[3] * p.x + frame[b].turn[4] * p.y) + frame[b].turn[5] * p.z,
               (frame[b].turn[6] * p.x + frame[b].turn[7] * p.y) + frame[b].turn[8] * p.z);
}

void change_frame(uint i) {
  if (i >= vertex_count) return;
  uint b = uint(rest_position[i].w);
  if (frame[b].turned == 0u) return;
  dvec3 rest = dvec3(vec3(rest_position[i]));
  uint at = 6u * (from_half * vertex_count + i);
  dvec3 displacement = turned(b, rest + LOAD3(motion, at)) - rest - LOAD3(frame[b].shift, 0u);
  dvec3 velocity = turned(b, LOAD3(motion, at + 3u));
  STORE3(motion, at, displacement)
  STORE3(motion, at + 3u, velocity)
  force[i] = real4(real3(turned(b, dvec3(real3(force[i])))), 0);
}
