#version 450
// One thread finds the light that reaches one place of the ground: x is the key light's share, y the sky's. The sky's share is the
// solid angle that the bodies above leave open.
#include "studio.glsl"
#include "key_light.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 1) uniform sampler2D footprint;  // with mipmaps
layout(binding = 0, rg16) writeonly uniform image2D ground_light;

const float pi = 3.14159265;
const int sky_taps = 8;

/// A horizontal element of area dA at height h and horizontal distance r hides h^2 dA / (pi (h^2 + r^2)^2) of the sky.
float sky_light(vec2 at, vec2 start) {
  float spacing = 1.6 * lit.w / float(sky_taps), hidden = 0.0;  // [m]
  vec2 side = start * (0.5 / ground.w);
  for (int i = 0; i < sky_taps; ++i) {
    float r = (float(i) + 0.5) * spacing, area = 2.0 * pi * r * spacing;
    vec2 above = textureLod(footprint, at + r * side, level_of(footprint, sqrt(area) / (2.0 * ground.w))).xy;
    float h = max((1.0 - above.y / max(above.x, 1e-4)) * ceiling * lit.w, spacing), squared = h * h + r * r;
    hidden += above.x * h * h * area / (pi * squared * squared);
    side = golden_turn * side;
  }
  return exp(-hidden);  // because bodies over each other count twice, and light comes back from their undersides
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  vec2 at = (vec2(texel) + 0.5) / vec2(imageSize(ground_light));
  vec2 xz = ground.xz + (at * 2.0 - 1.0) * ground.w;
  vec2 start = start_of(texel);
  float key = key_visibility(vec3(xz.x, ground.y, xz.y), vec3(0.0, 1.0, 0.0), Search(start, 0.05, 12, 12));
  imageStore(ground_light, texel, vec4(key, sky_light(at, start), 0.0, 0.0));
}
