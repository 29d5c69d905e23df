// The key light's own axes: x and y across the light, z towards it. The shadow map has x and y. Then the boxes that say what the maps
// cover.

/// Returns them as columns.
mat3 light_axes() {
  vec3 across = normalize(cross(vec3(0.0, 1.0, 0.0), key_direction.xyz));
  return mat3(across, cross(key_direction.xyz, across), key_direction.xyz);
}

/// Two boxes around vertices, each three lows and three highs. Minima and maxima of floats are those of integers that order alike.
layout(std430, binding = 2) buffer Bounds { uint bounds[12]; };
const uint lit_box = 0u;    // along the light's axes, of vertices that matter for the picture's light
const uint whole_box = 6u;  // of all vertices

uint ordered(float value) {
  uint bits = floatBitsToUint(value);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float value_of(uint ordered_bits) {
  return uintBitsToFloat((ordered_bits & 0x80000000u) != 0u ? ordered_bits & 0x7fffffffu : ~ordered_bits);
}
