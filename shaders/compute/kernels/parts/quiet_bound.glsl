#include "is_finite.glsl"
// What bound() and note_non_finite() are in quiet steps. A step that leaves a number that is not finite is undone. It is made again with
// all that belongs to a step, which notes the number.
void note_non_finite(uint b, uint i) { atomicMin(quiet_steps[0].undone, step_index); }

// A step is the last one if it moves a vertex out of its body's bounds.
void bound(uint i, uint b, uint k, float coordinate) {
  if (!is_finite(coordinate))
    note_non_finite(b, i);
  else if (coordinate < bounds.lower[k] || coordinate > bounds.upper[k])
    atomicMin(quiet_steps[0].end, step_index + 1u);
}
