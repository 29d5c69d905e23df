// enter_grid() enters a body into the grid. Needs the arrays `grid_list`, `grid_entry` and `grid_level`.
PARAMETER(uint, grid_lists)

// Not if it is empty, or has NaN.
bool is_a_box(IN(Box) box) {
  return box.upper.x >= box.lower.x && box.upper.y >= box.lower.y && box.upper.z >= box.lower.z;
}

void enter_grid(uint b, IN(Box) box) {
  grid_entry[b].level = no_level;
  if (!is_a_box(box)) return;
  GridEntry entry;
  for (int k = 0; k < 3; ++k) {
    entry.lower[k] = box.lower[k];
    entry.upper[k] = box.upper[k];
  }
  entry.level = level_of(box);
  uint list = list_of(cell_of(box, entry.level), entry.level, grid_lists);
  entry.next = atomicExchange(grid_list[list], b + 1u);
  grid_entry[b] = entry;
  uint word = entry.level / 32u, bit = 1u << entry.level % 32u;
  if ((ATOMIC_LOAD(grid_level[word]) & bit) == 0u) atomicOr(grid_level[word], bit);
}
