// One thread a vertex, before the first step: its placement, the very one that the end of a step would have left, and whether the
// body is deformed at all. There are no kept forces yet.
#include "../physics/body.glsl"
READ(body)
WRITE(frame)
READ(rest_position)
WRITE(placement)
READ(motion)
PARAMETER(uint, vertex_count)
#include "parts/place.glsl"

void place_vertices(uint i) {
  uint b = uint(rest_position[i].w);
  uint first = 6u * body[b].first_vertex;
  dvec3 relative = LOAD3(motion, 6u * i) - LOAD3(frame[b].reference, 0u);
  for (uint k = 0u; k < 3u; ++k)
    place(start_slot, i, k, body[b].inverse_unit, double(rest_position[i][int(k)]), relative[int(k)]);
  if (LOAD3(motion, 6u * i) != LOAD3(motion, first) || LOAD3(motion, 6u * i + 3u) != LOAD3(motion, first + 3u))
    ATOMIC_STORE(frame[b].deformed, 1u);
  if (i == body[b].first_vertex) frame[b].force_stale = 1u;
}
