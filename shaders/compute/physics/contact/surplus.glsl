// How a vertex is expected to move in a step. Forces act within it, so its mean velocity is not the one at its start. What it has beyond
// that is the surplus.
#ifndef SURPLUS_GLSL
#define SURPLUS_GLSL
#include "../language.glsl"
SHARED_BEGIN

// Returns the surplus that the coming step is expected to have, from those of the last one. Back from its end a step has a surplus, too:
// the velocity there less the mean one. Both change alike from step to step, and the end's is known sooner. So what is expected is right to
// second order, by Verlet to rounding, and where nothing changes it is the last one, whatever damping takes.
FN double expected_surplus(double of_start, double of_end, double of_end_before) {
  EXACT double expected = of_start + (of_end - of_end_before);
  return expected;
}

SHARED_END
#endif
