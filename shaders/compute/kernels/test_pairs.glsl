// Do the two triangles of a candidate pair touch? Threads share the list in strides.
#include "../physics/control.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
WRITE(0, Controls, Control, control)
READ(1, Candidates, uvec2, candidate)
READ(2, Triangles, uint, triangle)
READ(3, WorldPositions, vec4, world_position)
WRITE(4, Marks, uint, mark)
PARAMETER(0, uint, first_position)
PARAMETER(1, uint, triangle_test)
PARAMETER(2, uint, candidate_capacity)
PARAMETER(3, uint, thread_count)
#include "parts/mark_contact.glsl"

void test_pairs(uint item) {
  uint count = min(control[0].candidate_count, candidate_capacity);
  for (uint k = item; k < count; k += thread_count) mark_contact(candidate[k].x, candidate[k].y);
}
