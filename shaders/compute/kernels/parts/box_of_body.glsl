// The body's box [m]. Needs the array `body_box`.
Box box_of_body(uint b) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = from_ordered_bits(body_box[b].lower[k]);
    box.upper[k] = from_ordered_bits(body_box[b].upper[k]);
  }
  return box;
}
