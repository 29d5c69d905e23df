// What contacts know of a body, and constants of the method. docs/contact.md explains the method.
#ifndef SURFACE_GLSL
#define SURFACE_GLSL
#include "../language.glsl"
SHARED_BEGIN

// Steps of bodies that contacts press are no longer than this over (omega + g / 2), with the stiffest frequency omega and the rate of
// damping g. In longer ones contacts give energy: a vibration gains up to 9e-5 of its amplitude a step with 0.8 / omega, and up to 1.5e-3
// with 0.9 / omega (docs/contact.md).
const double longest_pressed_rate = double(0.8);

struct Surface {
  double edge;          // mean length of the mesh's edges [m]
  double inverse_mass;  // of a vertex [1/kg], 0 if the body is immovable
  double elasticity;
  double friction;
  double gap;              // that contacts keep, in edges
  double restitution;      // negative: none
  double longest_pressed;  // no part of a step is longer while contacts press the body [s]
  double frequency;        // the stiffest of the body's vibrations, omega [1/s], 0 if it is immovable
  double diameter;         // at rest, at most [m]
  double nearness;         // contacts of a pair matter where its features come as near as the sum of both [m]
  uint first_vertex;
  uint to_mesh;  // from a triangle of the body, in leaf order, to its place in `triangle_around`, modulo 2^32
  uint meets_itself;  // 1: contacts keep its surface from passing through itself
  uint padding;
  double winding;  // if that is of a sphere's kind: 1 if corners go counter-clockwise seen from outside, -1 if clockwise; else 0
};

// How much further than expected the vertices of a body may go.
struct Room {
  uint to_others;      // without meeting a body that is far [m], as bits of a float
  uint least_push[3];  // by which bodies that meet it may change a velocity along each axis [m/s], as bits that order as floats do
  uint most_push[3];
};

// A half-space that bodies stay out of: all points x with normal . x < offset.
struct Ground {
  double normal[3];
  double offset;  // [m]
  double elasticity;
  double friction;
  double gap;  // that contacts keep, in edges of the body
};

// Lists can be longer than they have room for.
struct ContactList {
  double last_part;          // what step_parts.last was at the part's start [s]. settle changes that while others read it
  uint triangle_pair_count;  // pairs of triangles whose cages overlap
  uint contact_count;        // contacts between them, and with grounds
  uint uncertified;          // pairs of triangles that were not proven to stay apart, and triangles of stars
  uint rounds_that_cut;      // of proofs, up to the last one that cut motions short
  uint arrivals;             // of work groups that wait for each other, 0 between kernels that go in rounds
  uint fastest;              // largest length of the expected velocities of vertices with contacts [m/s], as bits of a float
  uint heaviest;             // largest mass of these vertices [kg], as bits of a float
  uint latest_count;         // contacts of the latest step, which the lists hold until the next. None if it was undone
  uint is_tried;             // 1: the step is not empty, though it may be undone
  // The next four are of a kick whose sums are not near (near_sums.glsl).
  uint presses;              // 1: a contact gave an impulse in the first two rounds
  uint unsettled_round;      // the latest round in which a contact had not settled
  uint bounces_from;         // the first round in which a contact that bounces gave an impulse, or no_round
  uint bounce_round;         // the round in which impulses bounced, or no_round
  uint has_dues;             // 1: motions were cut short in this step, or contacts that ended unsettled gave energy
};

FN double reach_in_edges() { return double(1) / double(8); }  // that a vertex may move beyond what is expected
FN double reach_of_folds() { return double(1) / double(4); }  // the same where its surface may meet itself, and push it

// Returns the edge that distances of a pair count in [m]: the smaller one of bodies that move.
FN double edge_of_pair(IN(Surface) a, IN(Surface) b) {
  if (a.inverse_mass == double(0)) return b.edge;
  return b.inverse_mass == double(0) ? a.edge : min(a.edge, b.edge);
}

FN double sum_of_sizes(IN(dvec3) p) { return abs(p.x) + abs(p.y) + abs(p.z); }

// Returns the length of steps in which lost gap comes back fastest [s]. In shorter ones it does not come back faster.
FN double fastest_return(double frequency) { return longest_pressed_rate / max(frequency, double(1e-30)); }

// What positions in the world are rounded from, summed over the axes [m]: bounds of the place in the world and of the centre of its body,
// and the way between, which the radius at rest of the largest body bounds.
FN double rounded_from(double in_world, double of_centre, double largest_body) { return in_world + of_centre + double(4) * largest_body; }

// How far apart shadows of two triangles have to be on an axis whose components sum to 1 [m]. `size` bounds the corners' coordinates,
// summed, about one of the corners, and `far` is what that one is rounded from. Shadows err by at most 8 roundings of `size`, in numbers
// of this epsilon. Positions in the world err by some roundings in fp64. The margin is twice that.
FN double margin_of_rounding(double epsilon, double size, double far) {
  return double(16) * epsilon * size + double(64) * double(1.1e-16) * (far + size);
}

// Whether what the margin has beyond the shadows' errors is more than positions in the world err by in a million steps.
FN bool margin_outlasts_rounding(double epsilon, double size, double far) {
  return double(8) * epsilon * size > double(1e6) * double(4) * double(1.1e-16) * (far + size);
}

// Properties of a pair are geometric means.
FN double mean_of_pair(double a, double b) { return sqrt(a * b); }

// The distance that contacts keep [m].
FN double gap_of_pair(IN(Surface) a, IN(Surface) b) { return mean_of_pair(a.gap, b.gap) * edge_of_pair(a, b); }
FN double gap_above(IN(Ground) below, IN(Surface) a) { return mean_of_pair(a.gap, below.gap) * a.edge; }

// Proofs go in rounds. The first ones cut motions short at planes, the others stop vertices.
const uint plane_rounds = 4u;
const uint cut_rounds = 32u;

// `cut` has a row of parts from before the first round, and one from each that cuts at planes. Behind them stands the round in which a
// vertex was stopped. Of one that was not, it has at_a_cut if a pair of triangles that it belongs to was cut short, and at_no_cut otherwise.
const uint at_a_cut = cut_rounds;
const uint at_no_cut = cut_rounds + 1u;
FN uint cut_in(uint row, uint vertex_count, uint i) { return row * vertex_count + i; }
FN uint stop_of(uint vertex_count, uint i) { return cut_in(plane_rounds + 1u, vertex_count, i); }
const uint cut_rows = plane_rounds + 2u;
// Behind the rows stands, for the flight of each cluster and of each island, the round in which it was stopped, or at_no_cut.
FN uint flight_stop_of(uint vertex_count, uint flight) { return cut_rows * vertex_count + flight; }
// A body that was pressed keeps its bound on steps for so many more. Steps that change between long and short while bodies touch and part
// pump energy: up to 1.4 times the start's was measured.
const uint pressed_for = 64u;

const float sleeps_after = 0.5f;  // of being slow [s]
// A body may sleep though it trembles. The first bounds the root mean square of its vertices' speeds, over those that stand for it, and the
// second any vertex's, in multiples of the speed at which it may move. In heaps at rest the mean reached 3 times that speed in single steps,
// and single vertices 10 to 17 times.
const double tremble_ratio = double(4);
const double most_tremble_ratio = double(20);
const uint held_for = 2u;  // a body may sleep if a contact has pushed it in so many parts of steps, the latest ones

const uint contact_rows = 6u;  // of four numbers in `contact`
// A kick goes in rounds, until all contacts have settled. The first one adds what contacts at rest had in the last step. Impulses bounce in
// one round: when all contacts have settled, or else in the first one from forced_bounce on. Then rounds go on until all have settled
// again.
const uint fewest_kick_rounds = 9u;
const uint forced_bounce = 64u;
const uint fewest_rounds_from_bounce = 3u;  // its own is one of them
const uint most_kick_rounds = 129u;
const uint no_round = ~0u;
// From this one on contacts that have not settled jam: impulses along and across the normal raise each other. They lose friction. After a
// bounce they have as many rounds before that as after a forced one.
const uint jam_rounds = 81u;
// `kept_slot` finds a contact of the last step by its key. An entry has the step's number in its upper bits and the contact's in
// these lower ones.
const uint kept_index_bits = 18u;
// Where the sums of a step stand in `contact_sum`, behind the three components of the impulse.
const uint energy_given = 3u;
const uint energy_taken = 4u;
const uint friction_work = 5u;
const uint work_of_scripts = 6u;
const uint contact_sums = 7u;
FN uint unsettled_energy_of(uint b) { return contact_sums + b; }  // behind them, what contacts that ended unsettled gave each body
FN uint contact_sum_count(uint body_count) { return contact_sums + body_count; }

const uint sum_buffers = 3u;  // of impulses: one is read, one added to, one cleared

// Sums of |weight| of a vertex are counted in this unit, so that their order does not matter. All contacts that lists have room for can
// meet at one vertex.
FN float weight_unit() { return 1.0f / 8192.0f; }

SHARED_END
#endif
