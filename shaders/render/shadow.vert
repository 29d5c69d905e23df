#version 450
// Depth of the bodies seen from the key light.
#include "studio.glsl"
#include "surface.glsl"

void main() {
  vec3 world = world_position(uint(gl_VertexID));
  place_vertex(world, key_projection * vec4(world, 1.0));
}
