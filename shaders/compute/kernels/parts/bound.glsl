#include "note_non_finite.glsl"

// bound() extends the box of body b by coordinate k of vertex i [m]. If the number is not finite, it notes the vertex instead.
// is_finite() compares bits, because shader compilers turn comparisons of floats round as if there were no NaN.
bool is_finite(float number) { return (floatBitsToUint(number) & 0x7fffffffu) <= floatBitsToUint(3.0e38f); }

void bound(uint i, uint b, uint k, float coordinate) {
  if (!is_finite(coordinate)) {
    note_non_finite(b, i);
    return;
  }
  uint bits = ordered_bits(coordinate);
  LOWER_TO(body_box[b].lower[k], bits)
  RAISE_TO(body_box[b].upper[k], bits)
}
