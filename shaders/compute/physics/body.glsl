// What a thread knows of a body: `Body` never changes while a simulation runs, `Frame` does.
// Scalars and arrays of scalars only, so that std430 and C++ lay the structs out alike.
#ifndef BODY_GLSL
#define BODY_GLSL
#include "language.glsl"
SHARED_BEGIN

struct Body {
  double inverse_unit;  // [1/m]; forces are summed with lengths in a unit of the body's own, a power of two near its radius
  double unit_force;    // of a spring that is one unit too long: k times the unit, less Device::strain_bias [N]
  double inverse_mass;  // of a vertex [1/kg]
  double damping;       // c [kg/s]
  uint first_vertex;
  uint vertex_count;
};

// Some vertices of one body: what one work group of a force kernel serves.
struct Share {
  Body body;
  uint body_index;
  uint first_vertex;  // of the share
  uint vertex_count;
  uint tableau_row;   // where among the tableaus begins the one that the body steps by
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
  double reference[3];   // the displacement that those at the next step's start are relative to [m]
  double start_reference[3];  // ... at this step's start, where steps can be undone [m]
  double time_step;      // of the step being made, the same for all bodies [s]
  uint box[6];             // of the world positions at the step's end: lower and upper corner, as ordered bits
  uint non_finite_vertex;  // the body's first one at the step's end, or no_vertex
  uint turned;             // 1: this step ends with a change of frame
  uint deformed;           // 1: vertices move relative to each other, so springs have to be summed
  uint force_stale;        // 1: the spring forces kept from the step before do not hold
  uint force_evaluations;  // sums over all pairs of the body, so far
  uint forces_skipped;     // sums that were zero beforehand: no vertex moved relative to another
  uint frame_changes;      // so far
  uint halted;             // whether the body moves: see below
  uint arrivals;           // of work groups that wait for each other within this step
  uint padding;
};

// Values of Frame.halted.
const uint not_halted = 0u;
const uint halted_for_good = 1u;  // a step went non-finite; nothing moves any more
const uint halted_for_now = 2u;   // until the next step: this one is none, or was undone
const uint halted_waiting = 3u;   // for good: its work groups do not run at once, though they should
const uint most_polls = 1u << 22;  // before that is said; some seconds

const uint tableau_size = 1024u;  // rows: room for 29 stages, see runge_kutta_stage.glsl

const uint no_vertex = 0xffffffffu;

// Placements, where forces are taken, have three slots of all vertices: stages use the first two in turn.
const uint start_slot = 2u;  // the step's start, from the end of the step before
const uint slot_count = 3u;

// Where a vertex's position stands among the placements, and its displacement.
FN uint position_at(uint slot, uint vertex_count, uint i) { return 2u * slot * vertex_count + i; }
FN uint displacement_at(uint slot, uint vertex_count, uint i) { return (2u * slot + 1u) * vertex_count + i; }

// A row of a matrix times p.
FN double row_times(double x, double y, double z, IN(dvec3) p) {
  EXACT double sum = (x * p.x + y * p.y) + z * p.z;
  return sum;
}

FN dvec3 rotate(IN(Frame) frame, dvec3 p) {
  return dvec3(row_times(frame.rotation[0], frame.rotation[1], frame.rotation[2], p),
               row_times(frame.rotation[3], frame.rotation[4], frame.rotation[5], p),
               row_times(frame.rotation[6], frame.rotation[7], frame.rotation[8], p));
}

// R transposed times p.
FN dvec3 rotate_back(IN(Frame) frame, dvec3 p) {
  return dvec3(row_times(frame.rotation[0], frame.rotation[3], frame.rotation[6], p),
               row_times(frame.rotation[1], frame.rotation[4], frame.rotation[7], p),
               row_times(frame.rotation[2], frame.rotation[5], frame.rotation[8], p));
}

FN dvec3 to_world(IN(Frame) frame, dvec3 p) {
  EXACT dvec3 q = rotate(frame, p) + LOAD3(frame.origin, 0u);
  return q;
}

SHARED_END
#endif
