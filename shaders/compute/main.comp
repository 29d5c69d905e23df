// The frame around every kernel: the file itself comes in by name, and its function is called once for each item.
#version 450
#include "physics/language.glsl"
#include "@kernel"
layout(local_size_x = 64) in;
layout(location = 8) uniform uint item_count;
void main() {
  if (gl_GlobalInvocationID.x < item_count) KERNEL(gl_GlobalInvocationID.x);
}
