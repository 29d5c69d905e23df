// Stores a box in `cage`.
void store_vertex_box(uint at, vec3 lower, vec3 upper) {
  cage[at] = vec2(lower.x, lower.y);
  cage[at + 1u] = vec2(lower.z, upper.x);
  cage[at + 2u] = vec2(upper.y, upper.z);
}
