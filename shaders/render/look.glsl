// The studio: colours of lights and backdrop, and the way from linear light to the picture. All colours are linear RGB.
const vec3 key_color = vec3(1.0, 0.965, 0.91) * 2.3;
const vec3 sky_color = vec3(0.62, 0.70, 0.82) * 0.95;
const vec3 fill_color = vec3(0.55, 0.65, 0.85) * 0.35;
const vec3 horizon_color = vec3(0.60, 0.64, 0.69);
const vec3 zenith_color = vec3(0.25, 0.31, 0.40);
const vec3 pool_color = vec3(0.80, 0.81, 0.82);  // the ground under the lights

#include "taps.glsl"
layout(binding = 1) uniform sampler2D ground_light;  // x: key, y: sky, with mipmaps

/// Light on the ground at a place, 0 to 1: x of the key light, y of the sky. It is the mean over some `width` [m]. Beyond the map all
/// light arrives.
vec2 light_on_ground(vec2 xz, float width) {
  if (ground.w <= 0.0) return vec2(1.0);
  vec2 at = (xz - ground.xz) / ground.w;
  float inside = 1.0 - smoothstep(0.8, 1.0, max(abs(at.x), abs(at.y)));
  return mix(vec2(1.0), mean_at(ground_light, at * 0.5 + 0.5, level_of(ground_light, width / (2.0 * ground.w))), inside);
}

vec3 backdrop(vec3 direction) {
  return mix(horizon_color, zenith_color, smoothstep(-0.05, 0.55, direction.y));
}

/// What the ground reflects, by the light that reaches it.
vec3 ground_shade(vec2 light) {
  return pool_color * (vec3(0.54, 0.52, 0.49) * light.x + vec3(0.46, 0.48, 0.51) * mix(0.05, 1.0, light.y));
}

vec3 ground_color(vec3 hit) {
  float distance_to_centre = length(hit.xz - pool.xz) / pool.w;
  vec3 shade = ground_shade(light_on_ground(hit.xz, 0.0));
  return mix(shade, shade * horizon_color / pool_color, smoothstep(0.5, 6.0, distance_to_centre));
}

/// What the eye sees in a direction without bodies. The studio has no edges: the ground, bright under the lights, runs into a gradient.
vec3 surroundings(vec3 direction) {
  vec3 result = backdrop(direction);
  float t = (ground.y - eye.y) / min(direction.y, -1e-4);
  if (ground.w <= 0.0 || direction.y >= 0.0 || t <= 0.0) return result;
  vec3 hit = eye.xyz + t * direction;
  float haze = smoothstep(1.5, 12.0, length(hit.xz - pool.xz) / pool.w);
  return mix(ground_color(hit), result, haze);
}

/// Khronos' neutral curve keeps hues, and bends only what is brighter than 0.76 towards 1.
vec3 tone_map(vec3 color) {
  const float start = 0.76;
  float least = min(color.r, min(color.g, color.b));
  color -= least < 0.08 ? least - 6.25 * least * least : 0.04;
  float peak = max(color.r, max(color.g, color.b));
  if (peak < start) return color;
  float bent = 1.0 - (1.0 - start) * (1.0 - start) / (peak + 1.0 - 2.0 * start);
  return mix(color * (bent / peak), vec3(bent), 1.0 - 1.0 / (0.15 * (peak - bent) + 1.0));
}

vec3 to_srgb(vec3 linear) {
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

/// Noise that is spread evenly over neighbouring pixels (Jimenez, 2014), 0 to 1.
float noise_at(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }
