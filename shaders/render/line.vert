#version 450
// Draws one end of a line in the world, with its colour.
layout(location = 0) uniform mat4 view_projection;
layout(std430, binding = 0) readonly buffer Ends { vec4 ends[]; };  // [end][2]: place [m], colour
out vec4 line_color;

void main() {
  gl_Position = view_projection * vec4(ends[2 * gl_VertexID].xyz, 1.0);
  line_color = ends[2 * gl_VertexID + 1];
}
