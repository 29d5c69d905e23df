// Tests pairs of triangles, and marks the six vertices of those that touch. Triangles are given by their places in leaf order.
vec4 corner_at(uint t, uint k) { return world_position[first_position + triangle[corner_of(t, k)]]; }

bool triangles_touch(uint first, uint second) {
  vec3 p[3];
  vec3 q[3];
  for (uint k = 0u; k < 3u; ++k) {
    p[k] = vec3(corner_at(first, k));
    q[k] = vec3(corner_at(second, k));
  }
  return triangle_test == certified_test ? triangles_may_touch(p, q) : triangles_intersect_moller(p, q);
}

void mark_vertices(uint first, uint second) {
  for (uint k = 0u; k < 3u; ++k) {
    ATOMIC_STORE(mark[triangle[corner_of(first, k)]], control[0].step);
    ATOMIC_STORE(mark[triangle[corner_of(second, k)]], control[0].step);
  }
}

// Counts pairs: those that were tested, and those of them that touch.
void count_tests(uvec2 pairs) {
  TALLY_UP(control[0].count[triangle_tests], pairs.x)
  TALLY_UP(control[0].count[contact_pairs], pairs.y)
}

#ifdef __cplusplus
cpu::WaitingPairs waiting{};

uvec2 test_waiting() {
  const uint count = waiting.count();
  if (count == 0u) return uvec2(0u);
  return uvec2(count, triangle_test == certified_test ? waiting.test_in_vectors(*this) : waiting.test_by_kernel(*this));
}
void end_items() { count_tests(test_waiting()); }
#endif

// Tests a pair if it is near. On a processor it waits until 16 do. Returns how many pairs were tested now, and how many of them touch.
uvec2 test_if(bool near, uint first, uint second) {
#ifdef __cplusplus
  if (near) waiting.add(uvec2(first, second));
  return waiting.is_full() ? test_waiting() : uvec2(0u);
#else
  if (!near) return uvec2(0u);
  if (!triangles_touch(first, second)) return uvec2(1u, 0u);
  mark_vertices(first, second);
  return uvec2(1u);
#endif
}
