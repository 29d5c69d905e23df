#version 450
// The bodies projected along a direction onto the ground, in the ground map's square.
#include "studio.glsl"
#include "surface.glsl"
layout(location = 1) uniform vec3 direction;  // from the ground to the light, y > 0
out float height;  // above the ground [m]

void main() {
  vec3 world = world_position(uint(gl_VertexID));
  height = world.y - ground.y;
  vec2 foot = world.xz - direction.xz * (height / direction.y);
  place_vertex(world, vec4((foot - ground.xz) / ground.w, 0.0, 1.0));
}
