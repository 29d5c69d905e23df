// One thread serves one body. It empties the list of the grid that the body stands in.
#include "../physics/collision/grid.glsl"
READ(grid_entry)
WRITE(grid_list)
WRITE(grid_level)
PARAMETER(uint, grid_lists)

void leave_grid(uint b) {
  uint level = grid_entry[b].level;
  if (level == no_level) return;
  ATOMIC_STORE(grid_list[list_of(cell_of(box_of(grid_entry[b]), level), level, grid_lists)], 0u);
  ATOMIC_STORE(grid_level[level / 32u], 0u);
}
