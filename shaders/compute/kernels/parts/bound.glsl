#include "is_finite.glsl"
#include "note_non_finite.glsl"

// bound() extends the box of body b on axis k by what vertex i has: an interval or a coordinate [m]. If it is not finite, it notes the
// vertex instead.
void bound(uint i, uint b, uint k, float lower, float upper) {
  if (!is_finite(lower) || !is_finite(upper)) {
    note_non_finite(b, i);
    return;
  }
  uint least = ordered_bits(lower), most = ordered_bits(upper);
  LOWER_TO(body_box[b].lower[k], least)
  RAISE_TO(body_box[b].upper[k], most)
}
void bound(uint i, uint b, uint k, float coordinate) { bound(i, b, k, coordinate, coordinate); }
