// One thread a vertex, once a force of a splitting method: sum the springs, kick, then drift on, or end the step.
#include "../physics/body.glsl"
#include "../physics/damping.glsl"
#include "../physics/forces/spring.glsl"
READ(0, Bodies, Body, body)
WRITE(1, Frames, Frame, frame)
READ(2, RestPositions, vec4, rest_position)
WRITE(3, Stages, real4, stage)
WRITE(4, Forces, real4, force)
WRITE(5, Motions, double, motion)
WRITE(6, WorldPositions, vec4, world_position)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)
PARAMETER(2, uint, damping_law)
PARAMETER(3, double, kick_time)   // [s]
PARAMETER(4, double, drift_time)  // [s]; zero: the step ends here
PARAMETER(5, double, elapsed)     // time of the step that the drifts so far and the next one cover [s]
PARAMETER(6, uint, stage_index)
#include "parts/net_force.glsl"
#include "parts/end_step.glsl"
#include "parts/kick.glsl"

void splitting_stage(uint i) {
  uint b = uint(rest_position[i].w);
  if (frame[b].halted != 0u) return;
  real3 spring_force = body_spring_force(i, b, (stage_index & 1u) * vertex_count);
  force[i] = real4(spring_force, 0);
  uint after = 6u * ((1u - from_half) * vertex_count + i);
  dvec3 u = LOAD3(motion, after);
  dvec3 w = kicked(b, spring_force, LOAD3(motion, after + 3u), kick_time);
  if (drift_time == double(0)) {
    end_step(i, b, u, w);
    return;
  }
  uint reference = 6u * (from_half * vertex_count + body[b].first_vertex);
  dvec3 drifted = u + drift_time * w;
  dvec3 relative = (drifted - LOAD3(motion, reference)) - elapsed * LOAD3(motion, reference + 3u);
  stage[((stage_index + 1u) & 1u) * vertex_count + i] = real4(real3(relative), 0);
  STORE3(motion, after, drifted)
  STORE3(motion, after + 3u, w)
}
