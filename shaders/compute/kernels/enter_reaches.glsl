// One thread serves one body. It enters the box of all that the body can reach in the step into the grid.
#include "../physics/body.glsl"
#include "../physics/collision/grid.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
READ(surface)
READ_AS(place_box, BoxBits, body_box)
READ(body_motion)
READ(step_parts)
READ(status)
WRITE(grid_list)
WRITE(grid_entry)
WRITE(grid_level)
#include "parts/reach.glsl"
#include "parts/enter_grid.glsl"

void enter_reaches(uint b) { enter_grid(b, reach_box_of(b)); }
