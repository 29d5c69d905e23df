// How a vertex is expected to move in a step. Forces act within it, so its mean velocity is not the one at its start. What it has beyond
// that is the surplus. docs/contact.md explains how it is foreseen.
#ifndef SURPLUS_GLSL
#define SURPLUS_GLSL
#include "../language.glsl"
SHARED_BEGIN

// What is known after a step, along one axis [m/s].
struct Surplus {
  double expected;  // S: the surplus that is expected of the coming step
  double of_end;    // e: the velocity at the last step's end less its mean velocity. 0: no force acted, or no step was made
  double lead;      // s - e', where s is the last step's surplus and e' was that of the end before it
};

// Returns what was known if the steps so far had been `longer` times as long. A lead grows with the lengths of two steps.
FN Surplus in_longer_steps(Surplus known, double longer) {
  known.expected *= longer;
  known.of_end *= longer;
  known.lead *= longer * longer;
  return known;
}

// Returns what is known after another step with the surplus s and the surplus e of its end. `before` is what was known, as if steps had
// been as long as this one, which was `longer` times as long as the last. `share_of_end` of what e has changed by counts, and
// `share_of_lead` of what the lead has. A step that is far shorter, such as the last one before a frame, changes nothing that is known:
// later its roundings would be multiplied.
FN Surplus surplus_after(double s, double e, IN(Surplus) before, double longer, double share_of_end, double share_of_lead) {
  bool continues = before.of_end != double(0);
  if (continues && longer < double(0.1)) return before;
  EXACT double of_like_steps = double(2) * longer / (double(1) + longer);
  EXACT double lead = continues ? of_like_steps * (s - before.of_end) : double(0);
  EXACT double expected = continues ? s + share_of_end * (e - before.of_end) + share_of_lead * (lead - before.lead) : e;
  Surplus now;
  now.expected = expected;
  now.of_end = e;
  now.lead = lead;
  return now;
}

SHARED_END
#endif
