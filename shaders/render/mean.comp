#version 450
// One thread averages the 4 x 4 texels around the corner after one texel. The taps of all 16 are turned differently (taps.glsl).
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D map;
layout(binding = 0, rg16) writeonly uniform image2D mean;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(mean);
  if (any(greaterThanEqual(texel, size))) return;
  vec2 sum = vec2(0.0);
  for (int i = 0; i < 4; ++i)  // each lookup is the mean of four texels
    sum += textureLod(map, (vec2(texel) + vec2(i & 1, i >> 1) * 2.0) / vec2(size), 0.0).xy;
  imageStore(mean, texel, vec4(sum / 4.0, 0.0, 0.0));
}
