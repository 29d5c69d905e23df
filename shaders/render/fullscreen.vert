#version 450
// One triangle over the whole picture, and the camera's ray through each pixel.
#include "studio.glsl"
out vec2 place;  // 0 to 1
out vec3 ray;    // from the eye to the far plane

void main() {
  place = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  vec4 far = from_clip * vec4(place * 2.0 - 1.0, 1.0, 1.0);
  ray = far.xyz / far.w - eye.xyz;
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
