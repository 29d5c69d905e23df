// One thread a vertex, once a stage: the acceleration at this stage, then the position of the next stage, or the step's end.
// Second-order form: with abar = A A and bbar = b A, x_s = x + c_s h v + h^2 sum abar_sj a_j, so only accelerations are kept.
#include "../physics/body.glsl"
#include "../physics/damping.glsl"
#include "../physics/forces/spring.glsl"
READ(0, Bodies, Body, body)
WRITE(1, Frames, Frame, frame)
READ(2, RestPositions, vec4, rest_position)
WRITE(3, Stages, real4, stage)                  // two halves of vertex_count: read one, write the other
WRITE(4, Accelerations, double, acceleration)   // [stage][vertex][3]; a stage's velocity stands there until its acceleration does
WRITE(5, Motions, double, motion)               // two halves: the state before the step and after it
WRITE(6, WorldPositions, vec4, world_position)  // two halves likewise
READ(7, Tableau, double, tableau)               // rows 1 to stage_count: c_s, then abar_sj and a_sj in turn; the last row: 1, bbar_j, b_j
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)
PARAMETER(2, uint, damping_law)
PARAMETER(3, uint, stage_index)
PARAMETER(4, uint, stage_count)
PARAMETER(5, double, time_step)
#include "parts/net_force.glsl"
#include "parts/end_step.glsl"

dvec3 stage_acceleration(uint i, uint b) {
  uint at = 3u * (stage_index * vertex_count + i);
  dvec3 net_force = dvec3(body_spring_force(i, b, (stage_index & 1u) * vertex_count));
  dvec3 result = net_force / body[b].vertex_mass + LOAD3(frame[b].gravity, 0u);
  if (damping_law != damping_none)
    result -= damping_rate(damping_law, body[b].damping, body[b].vertex_mass, length(net_force)) * LOAD3(acceleration, at);
  STORE3(acceleration, at, result)
  return result;
}

void runge_kutta_stage(uint i) {
  uint b = uint(rest_position[i].w);
  if (frame[b].halted != 0u) return;
  stage_acceleration(i, b);
  bool last = stage_index + 1u == stage_count;
  bool needs_velocity = last || damping_law != damping_none;
  uint row = (stage_index + 1u) * (1u + 2u * stage_count);
  dvec3 position_sum = dvec3(0);
  dvec3 velocity_sum = dvec3(0);
  for (uint j = 0u; j <= stage_index; ++j) {
    dvec3 a = LOAD3(acceleration, 3u * (j * vertex_count + i));
    position_sum += tableau[row + 1u + 2u * j] * a;
    if (needs_velocity) velocity_sum += tableau[row + 2u + 2u * j] * a;
  }
  uint before = 6u * (from_half * vertex_count + i);
  dvec3 u = LOAD3(motion, before);
  dvec3 w = LOAD3(motion, before + 3u);
  dvec3 push = (time_step * time_step) * position_sum;
  dvec3 velocity = w + time_step * velocity_sum;
  if (last) {
    end_step(i, b, u + time_step * w + push, velocity);
    return;
  }
  uint reference = 6u * (from_half * vertex_count + body[b].first_vertex);
  double elapsed = tableau[row] * time_step;
  dvec3 relative = (u - LOAD3(motion, reference)) + elapsed * (w - LOAD3(motion, reference + 3u)) + push;
  stage[((stage_index + 1u) & 1u) * vertex_count + i] = real4(real3(relative), 0);
  if (needs_velocity) STORE3(acceleration, 3u * ((stage_index + 1u) * vertex_count + i), velocity)
}
