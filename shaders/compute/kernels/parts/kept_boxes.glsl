// Boxes of triangles as refit_cages kept them.
PaddedBox kept_box(uint at) {
  PaddedBox box;
  box.lower = triangle_bounds[at];
  box.upper = triangle_bounds[at + 1u];
  return box;
}
