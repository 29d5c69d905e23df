// Boxes of triangles as refit_cages kept them.
Box kept_box(uint at) {
  Box box;
  box.lower = vec3(triangle_bounds[at]);
  box.upper = vec3(triangle_bounds[at + 1u]);
  return box;
}
