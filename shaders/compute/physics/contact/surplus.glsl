// How a vertex is expected to move in a step. Forces act within it, so its mean velocity is not the one at its start. What it has beyond
// that is the surplus. Back from its end a step has a surplus, too: the velocity there less the mean one.
#ifndef SURPLUS_GLSL
#define SURPLUS_GLSL
#include "../language.glsl"
SHARED_BEGIN

// Along one axis [m/s].
struct Surplus {
  double expected;  // of the coming step
  double of_end;    // of the last step, 0 if there was none
  double lead;      // what that of the last step's start had beyond that of the end before it: nothing by Verlet's method
};

// Returns what is known after another step, from the surplus of its start and of its end, and from what was known before. What the end's
// has changed by is known a step sooner than what the start's will change by. `share` of it counts: 1 is exact for Verlet's method. For
// others the leads make up for most of what is missing. Where nothing changes the last surplus is expected, whatever damping takes: else
// bodies at rest would creep. docs/contact.md says how `share` was chosen.
FN Surplus surplus_after(double of_start, double of_end, IN(Surplus) before, double share) {
  Surplus now;
  now.of_end = of_end;
  bool is_first = before.of_end == double(0);
  EXACT double lead = is_first ? double(0) : of_start - before.of_end;
  EXACT double expected = is_first ? of_start : of_start + share * (of_end - before.of_end) + (lead - before.lead);
  now.lead = lead;
  now.expected = expected;
  return now;
}

SHARED_END
#endif
