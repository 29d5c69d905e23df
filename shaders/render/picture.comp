#version 450
// One thread draws one pixel of the picture. It shades what the pixel's samples see, once for each triangle among them, and averages.
// A body has a surface of soft plastic. It gets light from a key light with soft shadows, a fill light, the sky and the ground.
#include "studio.glsl"
#include "surface.glsl"
#include "seen.glsl"
#include "key_light.glsl"
#include "look.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 3) readonly buffer BodyColors { vec4 body_colors[]; };  // w: 1 if no light reaches the body's inside
layout(std430, binding = 4) readonly buffer Smooth { vec4 smooth_surface[]; };  // xyz: normal, w: strain
layout(binding = 3) uniform sampler2D occlusion;
layout(binding = 0, rgba8) writeonly uniform image2D picture;
layout(location = 1) uniform bool shows_strain;
layout(location = 4) uniform bool hides_insides;

const float pi = 3.14159265;
const float roughness = 0.42;

// BLOCKER_TAPS, SHADOW_TAPS and INNER_OUTLINES come from Detail (frame_renderer.hpp).

/// The colour map viridis (van der Walt and Smith), as Matt Zucker's polynomial of degree six, in linear RGB. `t` is 0 to 1.
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

/// Where a ray meets a body.
struct Hit {
  vec3 where, normal;  // the normal towards the eye
  vec3 albedo;
  bool is_inside;  // the eye is in the body, or sees into it
};

/// A vertex's normal and strain as one of its triangles has them. Across a sharp edge surfaces are not smooth: there the triangle has its
/// own normal.
vec4 surface_at(uint vertex, vec3 face) {
  const float crease = 0.85;  // cosine: sharper than 32 degrees to either side
  vec4 surface = smooth_surface[vertex];
  return dot(surface.xyz, face) < crease ? vec4(face, surface.w) : surface;
}

Hit hit_of(uint seen, vec3 ray) {
  Corners at = corners_of(seen);
  vec3 weights = weights_at(at, ray), area = face_normal(at), face = area / max(length(area), 1e-30);
  vec4 surface = mat3x4(surface_at(at.vertices[0], face), surface_at(at.vertices[1], face), surface_at(at.vertices[2], face)) * weights;
  vec3 normal = dot(surface.xyz, surface.xyz) > 1e-12 ? surface.xyz : face;
  uint body = uint(rest_positions[at.vertices[0]].w);
  float side = side_seen(at);
  return Hit(mat3(at.a, at.b, at.c) * weights, side * normalize(normal),
             shows_strain ? viridis(min(surface.w / full_strain, 1.0)) : body_colors[body].rgb,
             hides_insides && side < 0.0 && body_colors[body].w == 1.0);
}

/// Cook-Torrance with the GGX distribution and Kelemen's visibility term.
float highlight(vec3 normal, vec3 view, vec3 light) {
  vec3 halfway = normalize(view + light);
  float a2 = pow(roughness, 4.0), nh = max(dot(normal, halfway), 0.0), lh = max(dot(light, halfway), 0.05);
  float d = nh * nh * (a2 - 1.0) + 1.0;
  return 0.04 * a2 / (4.0 * pi * d * d * lh * lh) * max(dot(normal, light), 0.0);
}

/// Share of the surroundings that a rough surface of reflectance 0.04 mirrors (Lazarov's fit, 2013).
float mirrored_share(float facing) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  vec2 scale = vec2(-1.04, 1.04) * (min(r.x * r.x, exp2(-9.28 * facing)) * r.x + r.y) + r.zw;
  return 0.04 * scale.x + scale.y;
}

/// What comes along a mirrored ray. A rough surface spreads such rays, so the ground is blurred the more the farther away it is.
vec3 mirrored_light(vec3 where, vec3 ray) {
  const float spread = 4.0 * roughness * roughness;  // rays turn by twice as much as the microfacets' normals, to either side
  float away = (ground.y - where.y) / min(ray.y, -0.1);
  vec2 light = light_on_ground(where.xz + away * ray.xz, spread * away);
  return mix(ground_shade(light), backdrop(ray), smoothstep(-0.4, 0.4, ray.y));
}

vec3 shade(Hit hit, vec3 view, float open) {
  vec3 light = key_direction.xyz, normal = hit.normal;
  vec3 below = ground_shade(light_on_ground(hit.where.xz, 0.0));
  Search taps = Search(vec2(1.0, 0.0), 0.02, BLOCKER_TAPS, SHADOW_TAPS);
  float lit = max(dot(normal, light), 0.0) * key_visibility(hit.where, normal, taps);
  vec3 fill = fill_color * max(dot(normal, normalize(vec3(-light.x, 0.35 * light.y, light.z))) * 0.7 + 0.3, 0.0);
  vec3 around = mix(below * 0.6, sky_color, 0.5 + 0.5 * normal.y);
  vec3 mirrored = mirrored_light(hit.where, reflect(-view, normal));
  vec3 gloss = key_color * pi * highlight(normal, view, light) * min(lit * 8.0, 1.0) +
               mirrored * open * mirrored_share(max(dot(normal, view), 0.0));
  return hit.albedo * 0.40 * (key_color * lit + open * (fill + around)) + gloss;
}

float openness_at(vec2 place) {
  vec2 mean = mean_at(occlusion, place, 0.0);
  return mean.y > 0.0 ? mean.x / mean.y : 1.0;  // the mean over bodies alone
}

vec3 color_of(uint seen, vec3 ray, vec2 place) {
  vec3 direction = normalize(ray);
  if (seen == 0u) return surroundings(direction);
  Hit hit = hit_of(seen, ray);
  return hit.is_inside ? 0.05 * hit.albedo : shade(hit, -direction, openness_at(place));
}

/// Whether samples that see triangles a and b are shaded together. They see the same one, or without inner outlines any body.
bool are_alike(uint a, uint b) { return a == b || (!INNER_OUTLINES && a != 0u && b != 0u); }

/// Which of the pixel's samples are like one that sees this triangle, a bit each.
int samples_like(uint seen, ivec2 pixel) {
  int samples = 0;
  for (int i = 0; i < sample_count; ++i) samples |= int(are_alike(seen, triangle_at(pixel, i))) << i;
  return samples;
}

/// The mean of the samples' colours, as they will be shown.
vec3 average_color(ivec2 pixel, vec3 ray, vec2 place) {
  vec3 sum = vec3(0.0);
  int left = (1 << sample_count) - 1;
  do {
    uint seen = triangle_at(pixel, findLSB(left));
    int samples = samples_like(seen, pixel);
    sum += float(bitCount(samples)) * tone_map(color_of(seen, ray, place));
    left &= ~samples;
  } while (left != 0);
  return sum / float(sample_count);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(picture);
  if (any(greaterThanEqual(pixel, size))) return;
  vec2 place = (vec2(pixel) + 0.5) / vec2(size);
  vec3 color = to_srgb(average_color(pixel, ray_through(place), place));
  imageStore(picture, pixel, vec4(color + (noise_at(vec2(pixel)) - 0.5) / 255.0, 1.0));  // with noise gradients have no bands
}
