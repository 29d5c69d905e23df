// One thread a candidate: do the two triangles touch?
#include "../physics/control.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
WRITE(0, Controls, Control, control)
READ(1, Candidates, uvec2, candidate)
READ(2, Triangles, uint, triangle)
READ(3, WorldPositions, vec4, world_position)
WRITE(4, Marks, uint, mark)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, first_position)
PARAMETER(2, uint, triangle_test)
PARAMETER(3, uint, candidate_capacity)
#include "parts/mark_contact.glsl"

void test_pairs(uint item) {
  if (item >= min(control[0].candidate_count, candidate_capacity)) return;
  mark_contact(candidate[item].x, candidate[item].y);
}
