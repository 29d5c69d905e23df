// One thread runs sixteen independent chains of multiply-adds, the best that the GPU's vector units can do. Sums of springs are
// measured against it.
#version 450
layout(local_size_x = 256) in;
layout(std430, binding = 0) writeonly buffer Results { float result[]; };  // so that nothing is left out
layout(location = 0) uniform float factor;
layout(location = 1) uniform float addend;
layout(location = 2) uniform uint rounds;

void main() {
  vec4 a = vec4(0, 1, 2, 3) + float(gl_LocalInvocationID.x), b = a + 4, c = a + 8, d = a + 12;
  vec4 f = vec4(factor), g = vec4(addend);
#define ADVANCE a = fma(a, f, g); b = fma(b, f, g); c = fma(c, f, g); d = fma(d, f, g);
#define ADVANCE_4 ADVANCE ADVANCE ADVANCE ADVANCE
  for (uint round = 0u; round < rounds; ++round) { ADVANCE_4 ADVANCE_4 ADVANCE_4 ADVANCE_4 }
  vec4 sum = (a + b) + (c + d);
  result[gl_GlobalInvocationID.x] = (sum.x + sum.y) + (sum.z + sum.w);
}
