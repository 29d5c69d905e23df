// Boxes of triangles as refit_cages kept them.
Reach kept_box(uint at) {
  Reach box;
  box.lower = triangle_bounds[at];
  box.upper = triangle_bounds[at + 1u];
  return box;
}
