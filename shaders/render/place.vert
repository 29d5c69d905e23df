#version 450
// Puts a body's vertex where the camera, the key light or the map of the ground sees it. A vertex that cannot be drawn takes its
// triangles out of the picture.
#include "drawable.glsl"
#include "studio.glsl"
layout(location = 0) uniform uint view;  // 0: the camera's, 1: the light's, 2: from above
layout(location = 0) in vec3 position;  // world [m]
out float gl_ClipDistance[1];

void main() {
  bool drawable = is_drawable(position);
  mat4 to_clip = view == 0u ? view_projection : view == 1u ? key_projection : above_projection;
  gl_Position = drawable ? to_clip * vec4(position - centre.xyz, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);
  gl_ClipDistance[0] = drawable ? 1.0 : -1e10;
}
