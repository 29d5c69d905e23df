#version 450
// A studio backdrop: the ground, bright under the lights, runs without an edge into a gradient.
#include "studio.glsl"
#include "look.glsl"
in vec2 place;
in vec3 ray;
layout(location = 0) out vec4 color;

vec3 ground_color(vec3 hit) {
  vec2 light = light_on_ground(hit.xz);
  float distance_to_centre = length(hit.xz - centre.xz) / centre.w;
  vec3 base = mix(pool_color, horizon_color, smoothstep(0.5, 6.0, distance_to_centre));
  vec3 shade = vec3(0.54, 0.52, 0.49) * light.x + vec3(0.46, 0.48, 0.51) * mix(0.05, 1.0, light.y);
  return base * shade;
}

void main() {
  vec3 direction = normalize(ray);
  vec3 result = backdrop(direction);
  float t = (ground.y - eye.y) / min(direction.y, -1e-4);
  if (ground.w > 0.0 && direction.y < 0.0 && t > 0.0) {
    float haze = smoothstep(4.0, 16.0, t * length(direction.xz) / centre.w);
    result = mix(ground_color(eye.xyz + t * direction), result, haze);
  }
  // Half a step of ordered noise keeps the gradient free of bands in 8 bits.
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  color = vec4(tone_map(result) + noise / 255.0, 1.0);
}
