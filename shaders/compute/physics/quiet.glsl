// Quiet steps: steps in which no body can come near another or a ground. One dispatch makes many of them.
#ifndef QUIET_GLSL
#define QUIET_GLSL
#include "body.glsl"
#include "language.glsl"
SHARED_BEGIN

// A step is quiet as long as each body is in bounds at its start: then what bodies may reach in it is apart (kernels/parts/reach.glsl).
struct QuietBody {
  Pose before[2];           // at a step's start, of steps in turn
  float lower[3];           // bounds of the places of vertices [m]
  float upper[3];
  float least_velocity[3];  // and of the velocities that they are expected to have [m/s]
  float most_velocity[3];
  float room;               // how much further than expected a vertex may go in a step without being cut short [m]
  uint frame_changes;       // in these steps
};

struct QuietSteps {
  uint end;       // so many steps are made
  uint undone;    // the first one that does not stand, because it moved a vertex too far, or ~0
  uint arrivals;  // of work groups that wait for each other
  uint begun;     // 1: they have met, so that they run at once. Else no step is made
};

FN uint steps_made(IN(QuietSteps) s) { return s.begun == 0u ? 0u : s.end < s.undone ? s.end : s.undone; }

// As many at once. The first of these numbers is tried first for how long bodies keep apart.
const uint most_quiet_steps = 64u;
const uint fewest_quiet_steps = 2u;

SHARED_END
#endif
