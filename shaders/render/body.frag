#version 450
// A soft plastic surface under a key light with shadows, a fill light, the sky, and light from the ground.
#include "studio.glsl"
#include "look.glsl"
layout(binding = 1) uniform sampler2DShadow shadow_map;
layout(location = 2) uniform bool shows_strain;

centroid in vec3 world;
centroid in vec3 smooth_normal;
centroid in vec3 body_color;
centroid in float strain;
layout(location = 0) out vec4 color;

const float pi = 3.14159265;
const float full_strain = 0.3;  // the end of the colour scale
const int shadow_taps = 16;
const float roughness = 0.42;

/// Viridis (van der Walt and Smith), as Matt Zucker's polynomial of degree six, to linear RGB.
vec3 viridis(float t) {
  vec3 c = vec3(0.2777273272, 0.0054073445, 0.3340998053) +
           t * (vec3(0.1050930431, 1.4046135299, 1.3845901628) +
           t * (vec3(-0.3308618287, 0.2148475595, 0.0950951630) +
           t * (vec3(-4.6342304990, -5.7991009733, -19.3324409563) +
           t * (vec3(6.2282699363, 14.1799333668, 56.6905526007) +
           t * (vec3(4.7763849977, -13.7451453777, -65.3530326334) +
           t * vec3(-5.4354558559, 4.6458526122, 26.3124352496))))));
  return pow(clamp(c, 0.0, 1.0), vec3(2.2));
}

float key_visibility(vec3 normal) {
  float texel = 1.0 / float(textureSize(shadow_map, 0).x);
  vec4 at = key_projection * vec4(world + normal * (6.0 * texel * centre.w), 1.0);
  vec3 place = at.xyz * 0.5 + 0.5;
  const mat2 golden_turn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);
  vec2 side = vec2(4.5 * texel / sqrt(float(shadow_taps)), 0.0);
  float sum = 0.0;
  for (int i = 0; i < shadow_taps; ++i) {
    sum += textureLod(shadow_map, vec3(place.xy + sqrt(float(i) + 0.5) * side, min(place.z, 1.0)), 0.0);
    side = golden_turn * side;
  }
  return sum / float(shadow_taps);
}

/// Cook-Torrance with the GGX distribution and Kelemen's visibility term.
float highlight(vec3 normal, vec3 view, vec3 light) {
  vec3 halfway = normalize(view + light);
  float a2 = pow(roughness, 4.0), nh = max(dot(normal, halfway), 0.0), lh = max(dot(light, halfway), 0.05);
  float d = nh * nh * (a2 - 1.0) + 1.0;
  return 0.04 * a2 / (4.0 * pi * d * d * lh * lh) * max(dot(normal, light), 0.0);
}

vec3 ambient(vec3 normal, vec2 below) {
  vec3 bounce = pool_color * (key_color * 0.22 * below.x + sky_color * 0.35 * below.y);
  return mix(bounce, sky_color, smoothstep(-1.0, 1.0, normal.y)) * mix(0.55 + 0.45 * below.y, 1.0, max(normal.y, 0.0));
}

void main() {
  vec3 view = normalize(eye.xyz - world), light = key_direction.xyz;
  vec3 normal = dot(smooth_normal, smooth_normal) > 1e-12 ? normalize(smooth_normal) : view;
  if (!gl_FrontFacing) normal = -normal;  // both sides of an open surface show
  vec3 albedo = shows_strain ? viridis(min(strain / full_strain, 1.0)) : body_color;
  vec2 below = light_on_ground(world.xz);

  float facing = dot(normal, light);
  float lit = facing > 0.0 ? facing * key_visibility(normal) : 0.0;
  vec3 fill_direction = normalize(vec3(-light.x, 0.35 * light.y, light.z));
  vec3 diffuse = key_color * lit + fill_color * max(dot(normal, fill_direction) * 0.7 + 0.3, 0.0) + ambient(normal, below);
  float edge = pow(1.0 - max(dot(normal, view), 0.0), 4.0);
  vec3 mirrored = backdrop(reflect(-view, normal)) * mix(0.4 + 0.6 * below.y, 1.0, normal.y * 0.5 + 0.5);
  vec3 gloss = key_color * pi * highlight(normal, view, light) * min(lit * 8.0, 1.0) + mirrored * (0.03 + 0.42 * edge);
  color = vec4(tone_map(albedo * diffuse * 0.40 + gloss), 1.0);
}
