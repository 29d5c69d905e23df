#version 450
// Light that reaches each place of the ground: x the key light's share (a penumbra as wide as the casters are high), y the
// sky's share (the solid angle that the bodies above leave open).
#include "studio.glsl"
layout(binding = 0) uniform sampler2D key_footprint;
layout(binding = 1) uniform sampler2D above_footprint;
in vec2 place;
layout(location = 0) out vec2 light;

const float pi = 3.14159265;
const float key_softness = 0.11;  // tangent of the light's angular radius
const int blocker_taps = 12, penumbra_taps = 24, sky_taps = 24;
const mat2 golden_turn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);  // taps lie on a spiral of golden angles

/// Mip level whose texels are as wide as `width`, in units of the map.
float level_of(float width) { return log2(max(width * float(textureSize(key_footprint, 0).x), 1.0)); }

float height_of(vec2 footprint) { return max(1.0 - footprint.y / max(footprint.x, 1e-4), 0.0) * 4.0 * centre.w; }  // [m]

vec2 average(vec2 at, float radius, int taps) {
  float level = level_of(1.4 * radius / sqrt(float(taps)));
  vec2 sum = vec2(0.0), side = vec2(radius / sqrt(float(taps)), 0.0);
  for (int i = 0; i < taps; ++i) {
    sum += textureLod(key_footprint, at + sqrt(float(i) + 0.5) * side, level).xy;
    side = golden_turn * side;
  }
  return sum / float(taps);
}

float key_light(vec2 at) {
  float penumbra_per_height = key_softness / (key_direction.y * 2.0 * ground.w);
  vec2 blockers = average(at, 0.7 * centre.w * penumbra_per_height, blocker_taps);
  if (blockers.x < 1e-3) return 1.0;
  float radius = max(height_of(blockers) * penumbra_per_height, 3.0 / float(textureSize(key_footprint, 0).x));
  return 1.0 - average(at, radius, penumbra_taps).x;
}

/// A horizontal element of area dA at height h and horizontal distance r hides h^2 dA / (pi (h^2 + r^2)^2) of the sky.
float sky_light(vec2 at) {
  float reach = 1.6 * centre.w, spacing = reach / float(sky_taps), hidden = 0.0;  // [m]
  vec2 side = vec2(0.5 / ground.w, 0.0);
  for (int i = 0; i < sky_taps; ++i) {
    float r = (float(i) + 0.5) * spacing;
    float area = 2.0 * pi * r * spacing;
    vec2 footprint = textureLod(above_footprint, at + r * side, level_of(sqrt(area) / (2.0 * ground.w))).xy;
    float h = max(height_of(footprint), spacing), squared = h * h + r * r;
    side = golden_turn * side;
    hidden += footprint.x * h * h * area / (pi * squared * squared);
  }
  return exp(-hidden);  // bodies over each other count twice, and light comes back from their undersides
}

void main() { light = vec2(key_light(place), sky_light(place)); }
