// fit_treelet() fits the boxes of a treelet's nodes. The kernel says what the box of a triangle is.

PaddedBox box_of_triangles(uint begin, uint end) {
  PaddedBox box = box_of_triangle(begin);
  for (uint t = begin + 1u; t < end; ++t) box = joined(box, box_of_triangle(t));
  return box;
}

PaddedBox box_of_children(uint first, uint end) {
  PaddedBox box = box_of_node(first);
  for (uint n = first + 1u; n < end; ++n) box = joined(box, box_of_node(n));
  return box;
}

void fit_leaves(IN(Treelet) t) {
  for (uint n = t.first_node + THREAD; n < t.end_node; n += THREADS) {
    uvec4 at = node[n];
    if (at.x == 0u) store_box(n, box_of_triangles(at.z, at.w));
  }
}

// Fits nodes with children of this height. Children stand behind their parent, so a thread that is alone fits all from the last to the
// first.
void fit_inner_nodes(IN(Treelet) t, uint height) {
  uint count = t.end_inner - t.first_node, last = t.end_inner - 1u;
  for (uint k = THREAD; k < count; k += THREADS) {
    uvec4 at = node[last - k];
    if (at.x != 0u && (THREADS == 1u || at.z == height)) store_box(last - k, box_of_children(at.x, at.y));
  }
}

void fit_treelet(IN(Treelet) t) {
  fit_leaves(t);
  uint heights = THREADS == 1u ? min(t.levels, 2u) : t.levels;
  for (uint height = 1u; height < heights; ++height) {
    MEET
    fit_inner_nodes(t, height);
  }
}

// A hybrid refit leaves alone what no search needs, unless the list of pairs is too short.
bool is_needed(uint item, IN(Treelet) t) {
  if (status[t.body].partner_step != control[0].step) return false;
  return treelet_pair_capacity == 0u || control[0].treelet_pair_count > treelet_pair_capacity || treelet_step[item] == control[0].step;
}

void refit_treelet(uint item) {
  Treelet t = treelet[item];
  if (!is_needed(item, t)) return;
  fit_treelet(t);
  if (THREAD == 0u) atomicAdd(control[0].count[nodes_refitted], t.end_node - t.first_node);
  if (THREAD == 0u && item == tree[t.body].x && treelet_pair_capacity == 0u) atomicAdd(control[0].count[trees_refitted], 1u);
}
