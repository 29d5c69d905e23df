#include "is_finite.glsl"
#include "note_non_finite.glsl"

// bound() extends the box of body b by coordinate k of vertex i [m]. If the number is not finite, it notes the vertex instead.
void bound(uint i, uint b, uint k, float coordinate) {
  if (!is_finite(coordinate)) {
    note_non_finite(b, i);
    return;
  }
  uint bits = ordered_bits(coordinate);
  LOWER_TO(body_box[b].lower[k], bits)
  RAISE_TO(body_box[b].upper[k], bits)
}
