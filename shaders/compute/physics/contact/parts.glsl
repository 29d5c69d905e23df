// Parts of a step. Where bodies come near each other fast, or press each other, a scene's step falls into up to eight parts.
#ifndef PARTS_GLSL
#define PARTS_GLSL
#include "../language.glsl"
SHARED_BEGIN

struct StepParts {
  double full;        // length of the scene's steps [s]
  double last;        // length of the last part [s], 0 before the first one
  double simulated;   // [s]
  double lost;        // where even an eighth was too long, this was left out [s]
  uint eighths_left;  // of the scene's step
  uint steps;         // complete ones
  uint parts;         // made so far
  uint halvings;      // of the full step that the next part needs
  uint held;          // parts in which no body moved, because lists were too short or proofs were missing
  uint padding;
};

const uint eighths = 8u;
const uint most_halvings = 20u;

// Returns the size of the next part in eighths of a step.
FN uint next_eighths(IN(StepParts) p) {
  uint size = p.halvings < 3u ? eighths >> p.halvings : 1u;
  while (size > p.eighths_left) size /= 2u;
  return size;
}

// Returns the length of the next part [s]. A part that needs more than three halvings is shorter than its eighth.
FN double next_part(IN(StepParts) p) {
  double length = p.full * double(next_eighths(p)) / double(eighths);
  for (uint k = 3u; k < p.halvings; ++k) length *= double(0.5);
  return length;
}

// Counts a part that was made.
FN void end_part(INOUT(StepParts) p) {
  uint size = next_eighths(p);
  double length = next_part(p);
  p.last = length;
  p.simulated += length;
  p.lost += p.full * double(size) / double(eighths) - length;
  p.eighths_left -= size;
  p.parts += 1u;
  p.halvings = 0u;
  if (p.eighths_left != 0u) return;
  p.eighths_left = eighths;
  p.steps += 1u;
}

SHARED_END
#endif
