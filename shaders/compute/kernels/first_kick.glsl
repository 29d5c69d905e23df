// One thread a vertex, first in a step of a splitting method: kick by the kept force, then drift.
#include "../physics/body.glsl"
#include "../physics/damping.glsl"
READ(body)
WRITE(frame)
READ(rest_position)
WRITE(placement)
READ(kept_force)
WRITE(motion)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(uint, damping_law)
PARAMETER(double, kick_time)  // [s]
PARAMETER(double, drift_time)  // [s]
#include "parts/kick.glsl"
#include "parts/place.glsl"

void first_kick(uint i) {
  uint b = uint(rest_position[i].w);
  if (frame[b].halted != not_halted) return;
  if (i == body[b].first_vertex) frame[b].force_stale = 0u;  // refresh_force has seen to it
  dvec3 spring_force = LOAD3(kept_force, 3u * i);
  uint before = 6u * (from_half * vertex_count + i), after = 6u * ((1u - from_half) * vertex_count + i);
  uint first = 6u * (from_half * vertex_count + body[b].first_vertex);
  for (uint k = 0u; k < 3u; ++k) {
    double velocity = kicked(body[b], frame[b].gravity[k], kept_force[3u * i + k], dot(spring_force, spring_force),
                             motion[before + 3u + k], kick_time);
    double relative = (motion[before + k] - motion[first + k]) + drift_time * (velocity - motion[first + 3u + k]);
    place(0u, i, k, body[b].inverse_unit, double(rest_position[i][int(k)]), relative);
    motion[after + k] = motion[before + k] + drift_time * velocity;
    motion[after + 3u + k] = velocity;
  }
}
