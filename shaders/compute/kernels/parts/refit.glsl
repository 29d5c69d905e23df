// refit_tree() fits one leaf's box to its triangles, then goes up the leaf's subtree. The second of two siblings to arrive goes on to the
// parent. So no thread ever waits, and one dispatch refits every tree.

// The boxes of four triangles from t on, so that their loads overlap. Beyond the last triangle before `end`, its box repeats.
struct FourBoxes { Box first; Box second; Box third; Box fourth; };

FourBoxes four_boxes(uint t, uint end) {
  FourBoxes four;
  four.first = box_of_triangle(t);
  four.second = box_of_triangle(min(t + 1u, end - 1u));
  four.third = box_of_triangle(min(t + 2u, end - 1u));
  four.fourth = box_of_triangle(min(t + 3u, end - 1u));
  return four;
}

Box box_of_triangles(uint begin, uint end) {
  Box box = empty_box();
  for (uint t = begin; t < end; t += 4u) {
    FourBoxes four = four_boxes(t, end);
    box = joined(box, joined(joined(four.first, four.second), joined(four.third, four.fourth)));
  }
  return box;
}

void store_box(uint n, Box box) {
  node_box[lower_of(n)] = vec4(box.lower, 0);
  node_box[upper_of(n)] = vec4(box.upper, 0);
}

Box box_of_children(uint left) {
  Box box;
  box.lower = vec3(node_box[lower_of(left)]);
  box.upper = vec3(node_box[upper_of(left)]);
  return grow(grow(box, vec3(node_box[lower_of(left + 1u)])), vec3(node_box[upper_of(left + 1u)]));
}

void refit_tree(uint item) {
  if (status[leaf[item].y].partner_step != control[0].step) return;
  uint n = leaf[item].x;
  store_box(n, box_of_triangles(node[n].z, node[n].w));
  uint refitted = 1u;
  uint parent = node[n].y;
  while (parent != no_node) {
    memoryBarrierBuffer();
    if (atomicAdd(arrival[parent], 1u) == 0u) break;
    memoryBarrierBuffer();
    arrival[parent] = 0u;
    store_box(parent, box_of_children(node[parent].x));
    ++refitted;
    parent = node[parent].y;
  }
  TALLY_UP(control[0].count[trees_refitted], item == 0u || leaf[item - 1u].y != leaf[item].y ? 1u : 0u)
  TALLY_UP(control[0].count[nodes_refitted], refitted)
}
