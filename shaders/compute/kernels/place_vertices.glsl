// One thread places one vertex before the first step, exactly as the end of a step would have. It also finds out whether the body is
// deformed at all. There are no kept forces yet.
#include "../physics/body.glsl"
#include "../physics/layout.glsl"
READ(body)
READ(pose)
WRITE(status)
READ(rest_position)
WRITE(placement)
READ(motion)
PARAMETER(uint, vertex_count)
#include "parts/place.glsl"

void place_vertices(uint i) {
  uint b = uint(rest_position[i].w);
  uint first = body[b].first_vertex;
  dvec3 relative = LOAD3(motion, displacement_of(i)) - LOAD3(pose[b].reference, 0u);
  for (uint k = 0u; k < 3u; ++k)
    place(start_slot, i, k, body[b].inverse_unit, double(rest_position[i][int(k)]), relative[int(k)]);
  if (LOAD3(motion, displacement_of(i)) != LOAD3(motion, displacement_of(first)) ||
      LOAD3(motion, velocity_of(i)) != LOAD3(motion, velocity_of(first)))
    ATOMIC_STORE(status[b].deformed, 1u);
  if (i == body[b].first_vertex) status[b].force_stale = 1u;
}
