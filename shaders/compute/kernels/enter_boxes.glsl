// One thread serves one body. It enters the body into the grid with its box.
#include "../physics/body.glsl"
#include "../physics/collision/grid.glsl"
READ(tree)
READ(body_box)
READ(status)
WRITE(grid_list)
WRITE(grid_entry)
WRITE(grid_level)
#include "parts/box_to_touch.glsl"
#include "parts/enter_grid.glsl"

void enter_boxes(uint b) { enter_grid(b, box_to_touch(b)); }
