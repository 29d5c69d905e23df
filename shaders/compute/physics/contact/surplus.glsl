// How a vertex is expected to move in a step. Forces act within it, so its mean velocity is not the one at its start. What it has beyond
// that is the surplus. All here is over the step's length, as accelerations, so that steps of other lengths can follow.
// docs/contact.md explains how the surplus is foreseen.
#ifndef SURPLUS_GLSL
#define SURPLUS_GLSL
#include "../language.glsl"
SHARED_BEGIN

// What is known after a step, along one axis [m/s^2].
struct Surplus {
  double expected;  // S: the surplus that is expected of the coming step
  double of_end;    // e: the velocity at the last step's end less its mean velocity. 0: no force acted, or no step was made
  double lead;      // s - e', where s is the last step's surplus and e' was that of the end before it. 0: there is none, or not known
};

// Whether a step tells anything of the surplus. One that is far shorter than the last, such as what is left before a frame, tells of
// roundings: those of places count by the step's length squared. If more steps of that length follow, they tell.
FN bool tells_of_surplus(double time_step, double last_step) { return time_step >= last_step * double(0.001); }

// Returns what is known after another step of the length `time_step` [s], with the surplus `s` and the surplus `e` of its end [m/s].
// `before` is what was known. `share_of_end` of what e has changed by counts, and `share_of_lead` of what the lead has.
FN Surplus surplus_after(double s, double e, IN(Surplus) before, double time_step, double share_of_end, double share_of_lead) {
  bool continues = before.of_end != double(0);
  EXACT double of_start = s / time_step;
  EXACT double of_end = e / time_step;
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
