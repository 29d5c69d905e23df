// The box of the cages of a triangle's corners, at a place in leaf order.
Box box_of_triangle(uint t) {
  uint a = triangle[corner_of(t, 0u)], b = triangle[corner_of(t, 1u)], c = triangle[corner_of(t, 2u)];
  Box box;
  box.lower = vec3(cage[lower_of(a)]);
  box.upper = vec3(cage[upper_of(a)]);
  box = grow(grow(box, vec3(cage[lower_of(b)])), vec3(cage[upper_of(b)]));
  return grow(grow(box, vec3(cage[lower_of(c)])), vec3(cage[upper_of(c)]));
}
