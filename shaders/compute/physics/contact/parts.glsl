// Parts of a step. If bodies come near each other fast, or press each other, a scene's step falls into as many parts as it takes. With a
// tolerance steps have no fixed length, and are made shorter instead.
#ifndef PARTS_GLSL
#define PARTS_GLSL
#include "../language.glsl"
SHARED_BEGIN

struct StepParts {
  double full;       // length of the scene's steps, or with a tolerance of the step as errors allow it [s]
  double last;       // length of the last part [s], 0 before the first one
  uint left;         // of the scene's step, in units of the smallest part
  uint longest;      // bound on the next part [s], as bits of a float
  uint steps;        // complete ones
  uint parts;        // made so far
  uint held;         // parts in which no body moved, because lists were too short or proofs were missing
  uint divides;      // 1: steps fall into parts; 0: they are made shorter
};

// A step falls into so many parts at most. Motions that would need smaller ones are cut short.
const uint smallest_parts = 4096u;

const uint no_bound = 0x7f800000u;  // bits of infinity

// Before the first step. `full` is the length of the scene's steps [s].
FN StepParts before_first_part(double full, bool divides) {
  StepParts p;
  p.full = full;
  p.last = double(0);
  p.left = smallest_parts;
  p.longest = no_bound;
  p.steps = p.parts = p.held = 0u;
  p.divides = divides ? 1u : 0u;
  return p;
}

FN double length_of(IN(StepParts) p, uint size) { return p.full * (double(size) / double(smallest_parts)); }

// Returns the size of the next part, in units of the smallest one. It is a power of two.
FN uint next_size(IN(StepParts) p) {
  uint size = smallest_parts;
  double longest = double(uintBitsToFloat(p.longest));
  while (size > 1u && (size > p.left || length_of(p, size) > longest)) size /= 2u;
  return size;
}

// Returns the length of the next part [s]. If steps do not fall into parts, it is the step's length, and the target is `ahead` away [s].
// Then all steps up to it are equally long if the bound shortens them, because shapes at rest depend a little on the step's length. 1e-9
// keeps roundings from adding a step.
FN double next_part(IN(StepParts) p, double ahead) {
  if (p.divides != 0u) return length_of(p, next_size(p));
  double longest = double(uintBitsToFloat(p.longest));
  return p.full > longest ? ahead / ceil(ahead / longest - double(1e-9)) : p.full;
}

// Returns the factor of kept impulses before a part of the length `next` [s]: the ratio of lengths, but at most 16. `last` is 0 before the
// first part. At rest the mean length of neighbouring parts would be the exact measure. But scaled by that, a jam of three bodies more than
// doubled its energy.
FN double growth_of_kick(double last, double next) { return last > double(0) ? min(next / last, double(16)) : double(1); }

// Counts a part that was made and had this length.
FN void end_part(INOUT(StepParts) p, double made) {
  p.last = made;
  p.parts += 1u;
  p.left -= p.divides != 0u ? next_size(p) : p.left;
  if (p.left != 0u) return;
  p.left = smallest_parts;
  p.steps += 1u;
}

SHARED_END
#endif
