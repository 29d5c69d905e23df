// What a thread knows of a body. `Body` and `Share` never change while a simulation runs. The other structs are split by who reads them.
// Members are built from scalars and arrays of scalars only, so that std430 and C++ lay the structs out alike.
#ifndef BODY_GLSL
#define BODY_GLSL
#include "language.glsl"
SHARED_BEGIN

struct Body {
  double inverse_unit;  // [1/m] Forces are summed with lengths in the body's own unit, a power of two near its radius.
  double unit_force;    // force of a spring that is one unit too long: k times the unit, less Device::strain_bias [N]
  double inverse_mass;  // of a vertex [1/kg]
  double damping;       // c [kg/s]
  uint first_vertex;
  uint vertex_count;
};

// So many vertices, evenly spaced in the body's list, stand for the body where a mean will do. Returns the k-th of them.
const uint sample_count = 16u;
FN uint sample_vertex(uint first_vertex, uint vertex_count, uint k) { return first_vertex + k * vertex_count / sample_count; }

// Some vertices of one body: what one work group of a force kernel serves.
struct Share {
  Body body;
  uint body_index;
  uint first_vertex;  // of the share
  uint vertex_count;
  uint tableau_row;   // where the body's own tableau begins among the tableaus
};

// The body's moving frame. A vertex's world position is origin + R (X + u): X is its rest position, u its displacement in the frame.
// Its velocity in the world is R w, with w its velocity in the frame.
struct Pose {
  double origin[3];           // [m]
  double quaternion[4];       // of R: x, y, z, w
  double rotation[9];         // R, row by row
  double gravity[3];          // the scene's gravity in this frame [m/s^2]
  double reference[3];        // placements at the next step's start are relative to this displacement [m]
  double start_reference[3];  // those at this step's start are relative to this one, if steps can be undone [m]
};

// How the frame has followed the body at the end of this step. All that is stated in the frame has to follow, too.
struct FrameChange {
  double turn[9];   // R_old = R_new turn, row by row
  double shift[3];  // what is subtracted from every turned position [m]
  uint turned;      // 1: there is a change
  uint padding;
};

struct Status {
  uint activity;           // whether the body moves: see below
  uint non_finite_vertex;  // the body's first vertex that is not finite at the step's end or whose error ends the run, or no_vertex
  uint deformed;           // 1: vertices move relative to each other, so springs have to be summed
  uint force_stale;        // 1: the spring forces kept from the step before do not hold
  uint calm;               // steps in a row that left the body where it was, counted up to at_rest: see below
  uint partner_step;       // the latest step in which its box overlapped that of another, of which one was not at rest, or it might meet itself
  uint first_pair;         // one of the pairs of near bodies that it belongs to, by its number + 1; 0: none
  float slow_for;          // up to sleeps_after: how long it has been slow [s]; beyond: it is fit to sleep (find_sleepers.glsl)
  uint pressed_by_static;  // number of the latest part of a step in which a ground or a static body gave it an impulse, 0: none
  uint falls_asleep;       // 1: it sleeps from the end of this step on
  uint asleep;             // 1: it keeps its place and shape until it is disturbed, though forces may act on it
  uint disturbed;          // 1: a body that moves may reach it in this step, or one of its island; or something has moved it
  uint folds;              // 1: its surface may meet itself in this step
  uint steps_to_star;      // before quiet steps try again whether its surface stays a star
};

// Values of Status.calm. The first such step still expects motion, because of those before it. Nor does a body disturb others from
// `quiet` on. One at rest has been through a whole step that found it quiet, and nothing near. All that a step would find is what
// that one found, so it is left alone. Both halves of the state hold the same.
const uint quiet = 2u;
const uint at_rest = 3u;
const uint forgotten = 4u;  // at rest, but what a step finds of it is lost, so that the next one has to look
const uint steps_after_no_star = 8u;  // that are not quiet. Then quiet ones try again whether a body stays a star
// Bits of the parameter `skips`: what is left out because it changes nothing.
const uint skips_forces = 1u;  // of bodies that are not deformed
const uint skips_rest = 2u;    // all that is done for bodies at rest

FN bool is_idle(IN(Status) s) { return s.calm == at_rest && s.disturbed == 0u; }
FN bool is_asleep(IN(Status) s) { return s.asleep != 0u && s.disturbed == 0u; }
// Whether the step does not move it, unless something pushes it.
FN bool is_still(IN(Status) s) { return is_idle(s) || is_asleep(s); }

// What was done for the body so far.
struct Tally {
  uint force_evaluations;  // sums over all pairs of the body
  uint forces_skipped;     // sums that were zero beforehand: no vertex moved relative to another
  uint frame_changes;
  uint steps_at_rest;  // in which it was left alone
  uint steps_asleep;
};

// Values of Status.activity.
const uint moving = 0u;
const uint halted_for_good = 1u;  // a step went non-finite, and nothing moves any more
const uint halted_for_now = 2u;   // until the next step, because this one is empty or was undone
const uint halted_waiting = 3u;   // for good, because its work groups do not run at once, though they should
const uint immovable = 4u;        // keeps its place and shape
const uint scripted = 5u;         // keeps its shape and goes along its path
const uint most_polls = 1u << 22;  // of work groups that wait for others, which take some seconds
const uint most_polls_of_rehearsal = 1u << 14;  // some 20 ms
const uint waited_in_vain = 1u << 31;  // in counts of arrivals: work groups did not run at once, though they should

const uint no_vertex = 0xffffffffu;

// A row of a matrix times p.
FN double row_times(double x, double y, double z, IN(dvec3) p) {
  EXACT double sum = (x * p.x + y * p.y) + z * p.z;
  return sum;
}

// Turns a vector p of the frame into the world: R p.
FN dvec3 rotate(IN(Pose) pose, dvec3 p) {
  return dvec3(row_times(pose.rotation[0], pose.rotation[1], pose.rotation[2], p),
               row_times(pose.rotation[3], pose.rotation[4], pose.rotation[5], p),
               row_times(pose.rotation[6], pose.rotation[7], pose.rotation[8], p));
}

// Turns a vector p of the world into the frame: R transposed times p.
FN dvec3 rotate_back(IN(Pose) pose, dvec3 p) {
  return dvec3(row_times(pose.rotation[0], pose.rotation[3], pose.rotation[6], p),
               row_times(pose.rotation[1], pose.rotation[4], pose.rotation[7], p),
               row_times(pose.rotation[2], pose.rotation[5], pose.rotation[8], p));
}

// Where a point p of the frame [m] stands in the world [m].
FN dvec3 to_world(IN(Pose) pose, dvec3 p) {
  EXACT dvec3 q = rotate(pose, p) + LOAD3(pose.origin, 0u);
  return q;
}

SHARED_END
#endif
