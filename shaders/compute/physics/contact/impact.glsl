// Impacts of two bodies, or of a body and the grounds: how fast the two came, and what restitution leaves of it.
#ifndef IMPACT_GLSL
#define IMPACT_GLSL
#include "surface.glsl"
SHARED_BEGIN

// Where the impact of two bodies stands, with a < b. b may be body_count, which stands for all grounds.
FN uint impact_of(uint a, uint b, uint body_count) { return a * (body_count + 1u) + b; }
FN uint impact_count(uint body_count) { return body_count * (body_count + 1u); }

struct Impact {
  double approach;      // the largest speed at which the centres of mass came [m/s], 0: none yet
  uint parts_too_fast;  // 1: the two part faster than their restitution lets them
  uint padding;
};

// An impact ends after so many parts of steps without an impulse.
const uint impact_ends_after = 16u;

// Returns the restitution of a pair: the geometric mean, or that of the only one that has any. A negative one is none.
FN double restitution_of_pair(double a, double b) {
  if (a < double(0)) return b;
  return b < double(0) ? a : sqrt(a * b);
}

SHARED_END
#endif
