// Quiet steps: steps in which no contact needs an answer. One dispatch makes many of them.
#ifndef QUIET_GLSL
#define QUIET_GLSL
#include "body.glsl"
#include "language.glsl"
SHARED_BEGIN

// With contact by impulses a step is quiet if each body is in bounds at its start: then what bodies may reach in it is apart
// (kernels/parts/reach.glsl). Otherwise it is if each body is within its places at the end (kernels/give_room.glsl).
struct QuietBounds {
  float lower[3];  // of the places of vertices [m]
  float upper[3];
  float least_velocity[3];  // for impulses: of the velocities that they are expected to have [m/s]
  float most_velocity[3];
  float room;  // for impulses: how much further than expected a vertex may go in a step without being cut short [m]
  float surprise;  // for impulses: how far from where it is expected a vertex may end along each axis [m]
};

// What a quiet step knows of a body that has to stay a star (kernels/parts/quiet_star.glsl).
struct QuietStar {
  uint first_triangle;
  uint end_triangle;  // the first one, unless the body meets itself
  float winding;      // as the body's surface has it
  float edge;         // mean [m]
  float rounding;     // of positions in the world [m]
};

// Work groups that serve a body tell each other of its motion here.
struct QuietBody {
  QuietBounds bounds;
  QuietStar star;
  uint frame_changes;          // in these steps
  uint moving_share;           // entry n of the list of shares of bodies that move stands in quiet_body[n]
  FrameChange change;          // of the latest step whose frame has turned
  double reference[6];         // [half][3] as `pose` has it [m]
  double first_motion[12];     // [half][6] as `motion` has it of the first vertex
  double samples[96];          // [steps in turn][16][3] displacements at the step's end, of vertices that stand for the body [m]
};

struct QuietSteps {
  uint end;       // so many steps are made
  uint undone;    // the first one that does not stand, because of where it moved a vertex, or ~0
  uint arrivals;  // of work groups that wait for each other, and bits: waited_in_vain, and whether others have to look again
  uint begun;     // 1: they have met, so that they run at once. Else no step is made
  uint moving_shares;  // so many stand in the list
};

FN uint steps_made(IN(QuietSteps) s) { return s.begun == 0u ? 0u : s.end < s.undone ? s.end : s.undone; }

// A dispatch makes so many steps at most. Bounds are tried for as many first, then for half as many, and so on.
const uint most_quiet_steps = 1024u;
const uint fewest_quiet_steps = 2u;
const uint most_quiet_shares = 1024u;  // of bodies that move, where bodies may meet: each is compared with all
const uint has_news = 1u << 30;  // in arrivals: `end` or `undone` has changed

SHARED_END
#endif
