// The box of the triangle at a place in leaf order.
PaddedBox box_of_triangle(uint t) {
  vec4 p = world_position[first_position + triangle[corner_of(t, 0u)]];
  vec4 q = world_position[first_position + triangle[corner_of(t, 1u)]];
  vec4 r = world_position[first_position + triangle[corner_of(t, 2u)]];
  PaddedBox box;
  box.lower = min(min(p, q), r);
  box.upper = max(max(p, q), r);
  return box;
}
