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
WRITE(motion)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(uint, damping_law)
PARAMETER(double, parts_of)  // [s] these times are for steps of this length, if they can fall into parts; else 0
#include "parts/frame.glsl"
#include "parts/part_of_step.glsl"
#include "parts/kick.glsl"
#include "parts/place.glsl"
#include "parts/all_force.glsl"
#include "parts/first_kick.glsl"

void first_kick(uint i) {
  uint b = uint(rest_position[i].w);
  if (status[b].activity != moving || is_still(status[b])) return;
  // all axes are loaded before one is stored, so that loads overlap
  Decay d = first_decay(i, body[b]);
  Kicked x = first_kick_of(i, 0u, b, body[b], d), y = first_kick_of(i, 1u, b, body[b], d), z = first_kick_of(i, 2u, b, body[b], d);
  store_first_kick(i, 0u, body[b], x);
  store_first_kick(i, 1u, body[b], y);
  store_first_kick(i, 2u, body[b], z);
  if (i == body[b].first_vertex) status[b].force_stale = 0u;  // refresh_force has summed the springs again
}
