#include "is_finite.glsl"

// This step is the last one.
void end_with_step() {
  atomicMin(quiet_steps[0].end, step_index + 1u);
  atomicOr(quiet_steps[0].arrivals, has_news);
}

// This step does not stand.
void take_back_step() {
  atomicMin(quiet_steps[0].undone, step_index);
  atomicOr(quiet_steps[0].arrivals, has_news);
}

// What bound() and note_non_finite() are in quiet steps. A step that leaves a number that is not finite is undone. It is made again with
// all that belongs to a step, which notes the number.
void note_non_finite(uint b, uint i) { take_back_step(); }

// Contact by impulses knows that nothing meets in a step in which a vertex leaves its body's bounds, and it is the last one. Others look at
// where steps end, so that such a step is made again with all that belongs to it.
void bound(uint i, uint b, uint k, float coordinate) {
  if (!is_finite(coordinate))
    note_non_finite(b, i);
  else if (coordinate < bounds.lower[k] || coordinate > bounds.upper[k])
#ifdef IMPULSES
    end_with_step();
#else
    take_back_step();
#endif
}
