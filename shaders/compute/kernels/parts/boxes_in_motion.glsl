// Boxes around a triangle in motion, at a place in leaf order: around its corners' cages, and around the ways they go.
Reach reach_at(uint at) {
  Reach reach;
  reach.lower = cage[at];
  reach.upper = cage[at + 1u];
  return reach;
}

Reach box_of_cages(uint t) {
  Reach first = reach_at(cage_of(triangle[corner_of(t, 0u)])), second = reach_at(cage_of(triangle[corner_of(t, 1u)]));
  return joined(joined(first, second), reach_at(cage_of(triangle[corner_of(t, 2u)])));
}

// The box around the way of a triangle's corner.
Reach way_of_corner(uint t, uint k) { return reach_at(way_box_of(triangle[corner_of(t, k)])); }

Reach box_of_ways(uint t) { return joined(joined(way_of_corner(t, 0u), way_of_corner(t, 1u)), way_of_corner(t, 2u)); }
