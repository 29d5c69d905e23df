// Taps lie on a spiral, each a golden angle on from the one before. If a place has few taps, neighbouring texels start in different
// directions, 16 in each 4 x 4, and mean.comp averages over them.
const mat2 golden_turn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

/// Direction of a texel's first tap.
vec2 start_of(ivec2 texel) {
  float turn = 6.2831853 / 16.0 * float(((texel.x & 3) * 28 + (texel.y & 3) * 7) & 15);
  return vec2(cos(turn), sin(turn));
}

/// Mip level of a map whose texels are as wide as a share of the map.
float level_of(sampler2D map, float share) { return log2(max(share * float(textureSize(map, 0).x), 1.0)); }

/// The value of a map that mean.comp has made. `place` goes from 0 to 1 over the map.
vec2 mean_at(sampler2D means, vec2 place, float level) {
  return textureLod(means, place - 0.5 / vec2(textureSize(means, 0)), level).xy;
}
