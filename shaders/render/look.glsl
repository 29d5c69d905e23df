// The studio: colours of lights and backdrop, and the way from linear light to the picture. Linear RGB throughout.
const vec3 key_color = vec3(1.0, 0.965, 0.91) * 2.3;
const vec3 sky_color = vec3(0.62, 0.70, 0.82) * 0.95;
const vec3 fill_color = vec3(0.55, 0.65, 0.85) * 0.35;
const vec3 horizon_color = vec3(0.60, 0.64, 0.69);
const vec3 zenith_color = vec3(0.25, 0.31, 0.40);
const vec3 pool_color = vec3(0.80, 0.81, 0.82);  // the ground under the lights

layout(binding = 0) uniform sampler2D ground_light;  // x: key, y: sky

/// Light on the ground at a world place, 0 to 1: key, sky. All of it beyond the map.
vec2 light_on_ground(vec2 xz) {
  if (ground.w <= 0.0) return vec2(1.0);
  vec2 at = (xz - ground.xz) / ground.w;
  float inside = 1.0 - smoothstep(0.8, 1.0, max(abs(at.x), abs(at.y)));
  return mix(vec2(1.0), textureLod(ground_light, at * 0.5 + 0.5, 0.0).xy, inside);
}

vec3 backdrop(vec3 direction) {
  return mix(horizon_color, zenith_color, smoothstep(-0.05, 0.55, direction.y));
}

/// Leaves 0 to 0.7 alone and bends what is brighter towards 1.
vec3 tone_map(vec3 color) {
  vec3 shoulder = 0.7 + 0.3 * (1.0 - exp((0.7 - color) / 0.3));
  return mix(color, shoulder, greaterThan(color, vec3(0.7)));
}
