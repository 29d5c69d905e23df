// bound_treelet() fits the box of a treelet's root to its vertices. The kernel says what the box of a vertex is.
NEAR(PaddedBox, box_of_thread, THREADS)

void bound_treelet(uint item) {
  Treelet t = treelet[item];
  if (status[t.body].partner_step != control[0].step) return;
  PaddedBox box = box_of_vertex(treelet_vertex[min(t.first_vertex + THREAD, t.end_vertex - 1u)]);
  for (uint k = t.first_vertex + THREAD + THREADS; k < t.end_vertex; k += THREADS) box = joined(box, box_of_vertex(treelet_vertex[k]));
  box_of_thread[THREAD] = box;
  MEET
  if (THREAD != 0u) return;
  for (uint k = 1u; k < THREADS; ++k) box = joined(box, box_of_thread[k]);
  store_box(t.first_node, box);
  if (item == tree[t.body].x) atomicAdd(control[0].count[trees_refitted], 1u);
}
