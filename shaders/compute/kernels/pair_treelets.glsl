// One thread compares treelets of two near bodies, each with each. It lists those whose boxes overlap, and notes that a search needs them.
// Pairs are counted beyond the list's end, too.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/treelet.glsl"
WRITE(control)
READ(near_pair)
READ(tree)
READ(treelet)
READ(node_box)
WRITE(treelet_pair)
WRITE(treelet_step)
PARAMETER(uint, treelet_pair_capacity)
PARAMETER(uint, search_threads)
#include "parts/node_boxes.glsl"

void list_treelets(uint s, uint t) {
  APPEND(treelet_pair, control[0].treelet_pair_count, treelet_pair_capacity, uvec2(s, t))
  ATOMIC_STORE(treelet_step[s], control[0].step);
  ATOMIC_STORE(treelet_step[t], control[0].step);
}

void pair_treelets(uint item) {
  uint count = control[0].near_pair_count, of_a_pair = max(search_threads / max(count, 1u), 1u), stride = search_threads / of_a_pair;
  uint tests = 0u, pair = item / of_a_pair;
  if (pair >= stride) pair = count;  // left over
  for (; pair < count; pair += stride) {
    uvec4 first = tree[near_pair[pair].x], second = tree[near_pair[pair].y];
    for (uint s = first.x + item % of_a_pair; s < first.x + first.y; s += of_a_pair) {
      PaddedBox box = box_of_node(treelet[s].first_node);
      uint begin = first.x == second.x ? s : second.x, end = second.x + second.y;
      for (uint t = begin; t < end; ++t)
        if (overlaps(box, box_of_node(treelet[t].first_node))) list_treelets(s, t);
      tests += end - begin;
    }
  }
  TALLY_UP(control[0].count[node_tests], tests)
}
