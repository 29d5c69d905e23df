// What a thread knows of a body: `Body` never changes while a simulation runs, `Frame` does.
// Scalars and arrays of scalars only, so that std430 and C++ lay the structs out alike.
#ifndef BODY_GLSL
#define BODY_GLSL
#include "language.glsl"
SHARED_BEGIN

struct Body {
  double stiffness;    // k of every pair's spring [N/m]
  double vertex_mass;  // [kg]
  double damping;      // c [kg/s]
  uint first_vertex;
  uint vertex_count;
};

// A vertex stands at world position = origin + R (X + u): X the rest position, u the displacement in the body's frame.
// Its velocity is R w.
struct Frame {
  double origin[3];      // [m]
  double quaternion[4];  // of R: x, y, z, w
  double rotation[9];    // R, row by row
  double gravity[3];     // the scene's gravity in this frame [m/s^2]
  double turn[9];        // the latest change of frame, R_old = R_new turn, row by row
  double shift[3];       // ... and what it subtracts from every turned position [m]
  uint turned;             // 1: this step began with a change of frame
  uint deformed;           // 1: vertices move relative to each other, so springs have to be summed
  uint force_stale;        // 1: the spring forces kept from the step before do not hold
  uint refresh_force;      // 1: this step begins with a new sum of them
  uint force_evaluations;  // sums over all pairs of the body, so far
  uint forces_skipped;     // sums that were zero beforehand: no vertex moved relative to another
  uint halted;             // 1: an earlier step went non-finite; nothing moves any more
  uint padding;
};

FN dvec3 rotate(IN(Frame) frame, dvec3 p) {
  EXACT dvec3 q = dvec3((frame.rotation[0] * p.x + frame.rotation[1] * p.y) + frame.rotation[2] * p.z,
                        (frame.rotation[3] * p.x + frame.rotation[4] * p.y) + frame.rotation[5] * p.z,
                        (frame.rotation[6] * p.x + frame.rotation[7] * p.y) + frame.rotation[8] * p.z);
  return q;
}

FN dvec3 to_world(IN(Frame) frame, dvec3 p) {
  EXACT dvec3 q = rotate(frame, p) + LOAD3(frame.origin, 0u);
  return q;
}

SHARED_END
#endif
