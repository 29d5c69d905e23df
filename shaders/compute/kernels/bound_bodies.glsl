// One thread extends its body's box by one vertex at its world position. Steps do without: they bound their bodies as they end.
#include "../physics/body.glsl"
#include "../physics/collision/box.glsl"
WRITE(body_box)
WRITE(status)
READ(rest_position)
READ(world_position)
PARAMETER(uint, first_position)
PARAMETER(uint, body_count)
#include "parts/bound.glsl"

void bound_bodies(uint i) {
  for (uint k = 0u; k < 3u; ++k) bound(i, uint(rest_position[i].w), k, world_position[first_position + i][int(k)]);
}
