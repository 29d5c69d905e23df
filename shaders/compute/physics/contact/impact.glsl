// Impacts of two bodies, or of a body and the grounds. The smaller of two bodies keeps their impact. Only so many of its size or larger fit
// around it, while a large body may touch thousands that are smaller. One that has no place left for an impact ends all of its impacts.
#ifndef IMPACT_GLSL
#define IMPACT_GLSL
#include "surface.glsl"
SHARED_BEGIN

const uint impact_places = 64u;
const uint no_place = 0xffffffffu;
FN uint impact_at(uint keeper, uint place) { return impact_places * keeper + place; }
FN uint impact_count(uint body_count) { return impact_places * body_count; }

// Behind the impacts `impact_part` says for each body whether it lacked a place, and then what it says of all.
FN uint lack_of_places_of(uint b, uint body_count) { return impact_count(body_count) + b; }
FN uint latest_of_all(uint body_count) { return impact_count(body_count) + body_count; }

// An impact ends after so many parts of steps without an impulse.
const uint impact_ends_after = 16u;

// Returns the restitution of a pair: the geometric mean, or that of the only one that has any. A negative one is none.
FN double restitution_of_pair(double a, double b) {
  if (a < double(0)) return b;
  return b < double(0) ? a : sqrt(a * b);
}

SHARED_END
#endif
