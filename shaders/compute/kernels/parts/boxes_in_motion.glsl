// Boxes around a triangle in motion, at a place in leaf order: around its corners' cages, and around the ways they go.
#include "load_vertex_box.glsl"

PaddedBox box_of_cages(uint t) {
  PaddedBox first = load_vertex_box(cage_of(triangle[corner_of(t, 0u)])), second = load_vertex_box(cage_of(triangle[corner_of(t, 1u)]));
  return joined(joined(first, second), load_vertex_box(cage_of(triangle[corner_of(t, 2u)])));
}

// The box around the way of a triangle's corner.
PaddedBox way_of_corner(uint t, uint k) { return load_vertex_box(way_box_of(triangle[corner_of(t, k)])); }

PaddedBox box_of_ways(uint t) { return joined(joined(way_of_corner(t, 0u), way_of_corner(t, 1u)), way_of_corner(t, 2u)); }
