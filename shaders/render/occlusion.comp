#version 450
// How open the bodies' surfaces are to light from all around, by what stands before them in the picture. One thread serves one pixel,
// every second one of every second row. The method is from McGuire and others, "Scalable ambient obscurance", 2012.
#include "studio.glsl"
#include "surface.glsl"
#include "seen.glsl"
#include "taps.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rg16) writeonly uniform image2D occlusion;  // x: openness times y, y: 1 where there is a body

const int taps = 10;
const float reach = 0.22;  // in radii of what is lit
const float strength = 0.8;

vec3 point_at(ivec2 pixel, float depth) {
  vec2 place = (vec2(pixel) + 0.5) / vec2(textureSize(depths));
  vec4 point = from_clip * vec4(vec3(place, depth) * 2.0 - 1.0, 1.0);
  return point.xyz / point.w;
}

float openness(ivec2 pixel, vec3 where, vec3 normal, vec2 start) {
  float most = reach * lit.w, in_pixels = eye.w * most / distance(eye.xyz, where), hidden = 0.0;
  vec2 side = start * in_pixels / float(taps);
  for (int i = 0; i < taps; ++i) {
    ivec2 at = clamp(pixel + ivec2((float(i) + 0.5) * side), ivec2(0), textureSize(depths) - 1);
    float depth = depth_at(at, 0);
    vec3 to = point_at(at, depth) - where;
    float squared = dot(to, to), near = max(1.0 - squared / (most * most), 0.0);
    hidden += near * near * near * max(dot(to, normal) - 0.02 * most, 0.0) * most / (squared + 1e-3 * most * most);
    side = golden_turn * side;
  }
  return max(1.0 - strength * hidden * 2.0 / float(taps), 0.0);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), pixel = 2 * texel;
  if (any(greaterThanEqual(texel, imageSize(occlusion)))) return;
  uint seen = triangle_at(pixel, 0);
  vec2 result = vec2(0.0);
  if (seen != 0u) {
    Corners at = corners_of(seen);
    vec3 where = point_at(pixel, depth_at(pixel, 0)), normal = side_seen(at) * normalize(face_normal(at));
    result = vec2(openness(pixel, where, normal, start_of(texel)), 1.0);
  }
  imageStore(occlusion, texel, vec4(result, 0.0, 0.0));
}
