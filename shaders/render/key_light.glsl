// How much of the key light reaches a place. One shadow map gives percentage-closer soft shadows (Fernando, 2005). The light has a
// width, so a shadow is as soft as its caster is far away.
#include "taps.glsl"
layout(binding = 0) uniform sampler2D shadow_map;  // depth seen from the light, in a slice as in seen.glsl
layout(location = 3) uniform vec2 shadow_slice;    // where it begins, and its width

const float key_softness = 0.11;  // tangent of the light's angular radius

/// How a place asks for its light.
struct Search {
  vec2 start;              // direction of the first taps
  float widest;            // penumbra, as a share of the map
  int blocker_taps, taps;  // each of four texels
};

/// Which of four texels around a tap are before the receiver's own plane there (1, else 0), and their depths.
struct Tap {
  vec4 blocks, depths;
};

Tap tap_at(vec3 place, vec2 slope, vec2 offset) {
  vec4 depths = (textureGather(shadow_map, place.xy + offset) - shadow_slice.x) / shadow_slice.y;
  return Tap(vec4(lessThan(depths, vec4(min(place.z + dot(slope, offset), 0.99999)))), depths);
}

/// Interpolates between the four texels, in textureGather's order. GPUs choose texels by 8 bits of fraction, hence half a step more.
float share_blocked(Tap tap, vec2 at) {
  vec2 part = fract(at * vec2(textureSize(shadow_map, 0)) - 0.5 + 1.0 / 512.0);
  vec2 rows = mix(tap.blocks.wx, tap.blocks.zy, part.x);
  return mix(rows.x, rows.y, part.y);
}

/// How wide the shadow's rim is at a place, as a share of the map. It is 0 if nothing is between the place and the light.
float penumbra_at(vec3 place, vec2 slope, float texel, Search how) {
  const float widening = key_softness * depth_per_width;
  float reach = clamp(place.z * widening, 2.0 * texel, how.widest);
  vec2 side = how.start * (reach * inversesqrt(max(float(how.blocker_taps), 1.0))), sum = vec2(0.0);
  for (int i = 0; i < how.blocker_taps; ++i) {
    Tap tap = tap_at(place, slope, sqrt(float(i) + 0.5) * side);
    sum += vec2(dot(tap.blocks, tap.depths), dot(tap.blocks, vec4(1.0)));
    side = golden_turn * side;
  }
  return sum.y > 0.0 ? clamp((place.z - sum.x / sum.y) * widening, 2.0 * texel, how.widest) : 0.0;
}

/// The share of the key light that reaches `where` [m], 0 to 1. `normal` is the receiver's. If it is turned away, the share is 0.
/// A renderer in software takes both ways of a branch, but it skips loops without turns.
float key_visibility(vec3 where, vec3 normal, Search how) {
  bool facing = dot(normal, key_direction.xyz) > 0.0;
  float texel = 1.0 / float(textureSize(shadow_map, 0).x), blocked = 0.0;
  vec3 place = (key_projection * vec4(where + normal * (4.0 * texel * lit.w), 1.0)).xyz * 0.5 + 0.5;
  vec3 across = mat3(key_projection) * normal;
  vec2 slope = clamp(-across.xy / (across.z * depth_per_width * depth_per_width), -4.0, 4.0);
  if (!facing) how.blocker_taps = 0;
  float penumbra = penumbra_at(place, slope, texel, how);
  vec2 side = how.start * (penumbra / sqrt(float(how.taps)));
  for (int i = 0; i < (penumbra > 0.0 ? how.taps : 0); ++i) {
    vec2 offset = sqrt(float(i) + 0.5) * side;
    blocked += share_blocked(tap_at(place, slope, offset), place.xy + offset);
    side = golden_turn * side;
  }
  return facing ? 1.0 - blocked / float(how.taps) : 0.0;
}
