bool triangles_touch(IN_ARRAY(vec3, p, 3), IN_ARRAY(vec3, q, 3)) {
  return triangle_test == certified_test ? triangles_may_touch(p, q) : triangles_intersect_moller(p, q);
}

// Tests one pair of triangles, given by their places in leaf order. Marks the six vertices if the triangles touch. Returns how many pairs
// touch: 1 or 0.
uint mark_contact(uint first, uint second) {
  vec3 p[3];
  vec3 q[3];
  for (uint k = 0u; k < 3u; ++k) {
    p[k] = vec3(world_position[first_position + triangle[corner_of(first, k)]]);
    q[k] = vec3(world_position[first_position + triangle[corner_of(second, k)]]);
  }
  if (!triangles_touch(p, q)) return 0u;
  for (uint k = 0u; k < 3u; ++k) {
    ATOMIC_STORE(mark[triangle[corner_of(first, k)]], control[0].step);
    ATOMIC_STORE(mark[triangle[corner_of(second, k)]], control[0].step);
  }
  return 1u;
}
