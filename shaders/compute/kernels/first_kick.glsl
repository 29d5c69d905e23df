// One thread kicks one vertex by the kept force and then drifts it, first in a step of a splitting method.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/damping.glsl"
#include "../physics/layout.glsl"
READ(control)
READ(body)
READ(pose)
WRITE(status)
READ(rest_position)
WRITE(placement)
READ(kept_force)
READ(added_force)
WRITE(motion)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(uint, damping_law)
PARAMETER(uint, adds_force)  // 1: there are forces beside the springs
PARAMETER(double, kick_time)  // [s]
PARAMETER(double, drift_time)  // [s]
PARAMETER(double, parts_of)  // [s] these times are for steps of this length, if they can fall into parts; else 0
#include "parts/part_of_step.glsl"
#include "parts/kick.glsl"
#include "parts/place.glsl"

void first_kick(uint i) {
  uint b = uint(rest_position[i].w);
  if (status[b].activity != moving || is_still(status[b])) return;
  if (i == body[b].first_vertex) status[b].force_stale = 0u;  // refresh_force has summed the springs again
  dvec3 spring_force = LOAD3(kept_force, force_of(i));
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  uint first = in_half(from_half, vertex_count, body[b].first_vertex);
  for (uint k = 0u; k < 3u; ++k) {
    double all_force = kept_force[force_of(i) + k];
    if (adds_force != 0u) all_force += added_force[force_of(i) + k];
    double velocity = kicked(body[b], pose[b].gravity[k], all_force, dot(spring_force, spring_force),
                             motion[velocity_of(before) + k], part_of_step() * kick_time);
    double relative = (motion[displacement_of(before) + k] - motion[displacement_of(first) + k]) +
                      part_of_step() * drift_time * (velocity - motion[velocity_of(first) + k]);
    place(slot_of_force(0u), i, k, body[b].inverse_unit, double(rest_position[i][int(k)]), relative);
    motion[displacement_of(after) + k] = motion[displacement_of(before) + k] + part_of_step() * drift_time * velocity;
    motion[velocity_of(after) + k] = velocity;
  }
}
