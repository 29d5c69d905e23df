#version 450
// Puts a body's vertex where a camera or a light sees it. A vertex that cannot be drawn takes its triangles out of the picture.
#include "drawable.glsl"
#include "studio.glsl"
layout(location = 0) uniform mat4 to_clip;
layout(location = 0) in vec3 position;  // world [m]
out float gl_ClipDistance[1];

void main() {
  bool drawable = is_drawable(position);
  gl_Position = drawable ? to_clip * vec4(position - centre.xyz, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);
  gl_ClipDistance[0] = drawable ? 1.0 : -1e10;
}
