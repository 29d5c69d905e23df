// Boxes around a triangle in motion, at a place in leaf order: around its corners' cages, and around the ways they go.
Box box_around(uint a, uint b, uint c) {
  Box box;
  box.lower = vec3(min(min(cage[a], cage[b]), cage[c]));
  box.upper = vec3(max(max(cage[a + 1u], cage[b + 1u]), cage[c + 1u]));
  return box;
}

Box box_of_cages(uint t) {
  return box_around(cage_of(triangle[corner_of(t, 0u)]), cage_of(triangle[corner_of(t, 1u)]), cage_of(triangle[corner_of(t, 2u)]));
}

Box box_of_ways(uint t) {
  return box_around(way_box_of(triangle[corner_of(t, 0u)]), way_box_of(triangle[corner_of(t, 1u)]), way_box_of(triangle[corner_of(t, 2u)]));
}
