// The boxes of nodes, in the array `node_box`.
PaddedBox box_of_node(uint n) {
  PaddedBox box;
  box.lower = node_box[lower_of(n)];
  box.upper = node_box[upper_of(n)];
  return box;
}
