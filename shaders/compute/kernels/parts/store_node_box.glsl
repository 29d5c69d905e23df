// Stores the box of a node in the array `node_box`.
void store_box(uint n, IN(PaddedBox) box) {
  node_box[lower_of(n)] = box.lower;
  node_box[upper_of(n)] = box.upper;
}
