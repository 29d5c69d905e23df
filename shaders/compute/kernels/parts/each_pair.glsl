// visit_pairs() calls meet(a, b), a below b, once for each two bodies whose boxes overlap. The kernel says which boxes: box_to_meet(b) is a
// body's, and if there is a grid, the body has been entered with it. Needs the arrays `grid_list`, `grid_entry` and `grid_level`, and
// the parameter `body_count`.
PARAMETER(uint, grid_lists)  // 0: there is no grid, and one thread compares two bodies
PARAMETER(uint, threads_of_body)  // that share the cells around it, if there is a grid

// A list has bodies of other cells, too. Two bodies of one cell meet once.
void look_into(uint b, ivec3 cell, uint level, bool is_own_cell) {
  for (uint k = grid_list[list_of(cell, level, grid_lists)]; k != 0u; k = grid_entry[k - 1u].next) {
    uint other = k - 1u;
    if (grid_entry[other].level != level || (is_own_cell && other <= b)) continue;
    Box box = box_of(grid_entry[other]);
    if (cell_of(box, level) == cell && overlaps(box_of(grid_entry[b]), box)) meet(min(b, other), max(b, other));
  }
}

// On its own level a body leaves half of the cells around it to those that stand there.
void look_around(uint b, uint level, uint thread) {
  const uint own_cell = 13u;
  bool is_own_level = level == grid_entry[b].level;
  ivec3 centre = cell_of(box_of(grid_entry[b]), level);
  uint first = is_own_level || level == last_level ? own_cell : 0u, end = level == last_level ? own_cell + 1u : 27u;
  for (uint k = first + thread; k < end; k += threads_of_body)
    look_into(b, centre + ivec3(int(k % 3u), int(k / 3u % 3u), int(k / 9u)) - 1, level, is_own_level && k == own_cell);
}

// The first level from this one on that a body stands on, or no_level.
uint next_level(uint level) {
  for (uint word = level / 32u; word < level_words; ++word) {
    uint bits = grid_level[word] & (word == level / 32u ? ~0u << level % 32u : ~0u);
    if (bits != 0u) return 32u * word + uint(findLSB(bits));
  }
  return no_level;
}

void visit_pairs(uint item) {
  if (grid_lists == 0u) {
    uint a = item / body_count, b = item % body_count;
    if (a < b && overlaps(box_to_meet(a), box_to_meet(b))) meet(a, b);
    return;
  }
  uint b = item / threads_of_body;
  for (uint level = grid_entry[b].level; level != no_level; level = next_level(level + 1u))
    look_around(b, level, item % threads_of_body);
}

// The body that the thread serves beside pairs, or no_body. Each has one thread.
const uint no_body = ~0u;
uint body_of(uint item) {
  uint threads = grid_lists == 0u ? body_count + 1u : threads_of_body;
  return item % threads == 0u ? item / threads : no_body;
}
