// How a vertex is expected to move in a step. Forces act within it, so its mean velocity is not the one at its start. What it has beyond
// that is the surplus. What is kept is over the step's length, as accelerations, so that steps of other lengths can follow.
// docs/contact.md explains how the surplus is foreseen.
#ifndef SURPLUS_GLSL
#define SURPLUS_GLSL
#include "../language.glsl"
SHARED_BEGIN

// What is known after a step, along one axis [m/s^2].
struct Surplus {
  double expected;  // S: the surplus that is expected of the coming step
  double of_end;    // z: the velocity at the last step's end less its mean velocity. 0: no force acted, or no step was made
  double lead;      // s - z', where s is the last step's surplus and z' was that of the end before it. 0: there is none, or not known
};

// Whether a step tells anything of the surplus. One that is far shorter than the last, such as what is left before a frame, tells of
// roundings: those of places count by the step's length squared. If more steps of that length follow, they tell.
FN bool tells_of_surplus(double time_step, double last_step) { return time_step >= last_step * double(0.001); }

// Returns what is known after another step of the length `time_step` [s]. In it the mean velocity was `gained_at_start` more than the one
// at its start, and the one at its end was `gained_at_end` more than the mean [m/s]. `before` is what was known. Of what the end's surplus
// has changed by `share_of_end` counts, and of the lead's change `share_of_lead`.
FN Surplus surplus_after(double gained_at_start, double gained_at_end, IN(Surplus) before, double time_step, double share_of_end,
                         double share_of_lead) {
  bool continues = before.of_end != double(0);
  EXACT double of_start = gained_at_start / time_step;
  EXACT double of_end = gained_at_end / time_step;
  EXACT double lead = continues ? of_start - before.of_end : double(0);
  EXACT double more_at_end = share_of_end * (of_end - before.of_end);
  EXACT double more_lead = before.lead != double(0) ? share_of_lead * (lead - before.lead) : double(0);
  EXACT double expected = continues ? of_start + more_at_end + more_lead : of_end;
  Surplus now;
  now.expected = expected;
  now.of_end = of_end;
  now.lead = lead;
  return now;
}

SHARED_END
#endif
