// bound_treelet() fits the box of a treelet's root to its vertices. The kernel says what the box of a vertex is.
NEAR(PaddedBox, box_of_thread, THREADS)

PaddedBox box_of_place(uint place) { return box_of_vertex(treelet_vertex[place]); }

// A minimum waits for the one before. Of four joined by pairs, one is in the chain.
PaddedBox box_of_four(uint place) {
  return joined(joined(box_of_place(place), box_of_place(place + THREADS)),
                joined(box_of_place(place + 2u * THREADS), box_of_place(place + 3u * THREADS)));
}

void bound_treelet(uint item) {
  Treelet t = treelet[item];
  if (status[t.body].partner_step != control[0].step) return;
  PaddedBox box = box_of_place(min(t.first_vertex + THREAD, t.end_vertex - 1u));
  uint place = t.first_vertex + THREAD + THREADS;
  for (; place + 3u * THREADS < t.end_vertex; place += 4u * THREADS) box = joined(box, box_of_four(place));
  for (; place < t.end_vertex; place += THREADS) box = joined(box, box_of_place(place));
  box_of_thread[THREAD] = box;
  MEET
  if (THREAD != 0u) return;
  for (uint k = 1u; k < THREADS; ++k) box = joined(box, box_of_thread[k]);
  store_box(t.first_node, box);
  if (item == tree[t.body].x) atomicAdd(control[0].count[trees_refitted], 1u);
}
