// Loads a box from `cage`.
PaddedBox load_vertex_box(uint at) {
  PaddedBox box;
  vec2 xy = cage[at], z_and_x = cage[at + 1u], yz = cage[at + 2u];
  box.lower = vec4(xy.x, xy.y, z_and_x.x, 0);
  box.upper = vec4(z_and_x.y, yz.x, yz.y, 0);
  return box;
}
