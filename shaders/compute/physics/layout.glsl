// Where things stand in arrays that hold several numbers an item. physics/arrays.glsl lists the arrays.
#ifndef LAYOUT_GLSL
#define LAYOUT_GLSL
#include "language.glsl"
SHARED_BEGIN

// `motion` and `world_position` have two halves: one before a step and one after it. Returns the place of vertex i in either array.
FN uint in_half(uint half_index, uint vertex_count, uint i) { return half_index * vertex_count + i; }
FN uint other_half(uint half_index) { return 1u - half_index; }

// The first of the three numbers in `motion`. `place` is the vertex's, from in_half().
const uint motion_size = 6u;  // numbers of a vertex
FN uint displacement_of(uint place) { return motion_size * place; }
FN uint velocity_of(uint place) { return motion_size * place + 3u; }

// The first of the three numbers of vertex i: in `added_force`, `kept_force` and the like, and in `acceleration`.
FN uint force_of(uint i) { return 3u * i; }
FN uint acceleration_of(uint stage, uint vertex_count, uint i) { return 3u * (stage * vertex_count + i); }

// `start` has six numbers a vertex: where it is in the world, and its velocity there. `surplus` holds three numbers a vertex of each of
// what contact/surplus.glsl lists. `impulse_sum` has three sums a vertex in each of its buffers.
FN uint start_position_of(uint i) { return 6u * i; }
FN uint start_velocity_of(uint i) { return 6u * i + 3u; }
FN uint expected_surplus_of(uint i) { return 3u * i; }
FN uint end_surplus_of(uint vertex_count, uint i) { return 3u * (vertex_count + i); }
FN uint surplus_lead_of(uint vertex_count, uint i) { return 3u * (2u * vertex_count + i); }
FN uint impulse_sum_of(uint buffer_index, uint vertex_count, uint i) { return 3u * (buffer_index * vertex_count + i); }

// `slept` has four numbers a body: energy, then momentum.
FN uint energy_slept_of(uint b) { return 4u * b; }
FN uint momentum_slept_of(uint b) { return 4u * b + 1u; }

// Where the k-th number of a vector of four stands in an array that a kernel uses as single numbers.
FN uint number_of(uint vector, uint k) { return 4u * vector + k; }

// `placement` has up to four slots of all vertices. Stages use the second and the third in turn.
const uint start_slot = 0u;     // the step's start, which the end of the step before writes
const uint rounding_slot = 3u;  // notes what rounding has done
const uint slots_of_stages = 4u;
FN uint slots_of_splitting(uint forces) { return forces == 1u ? 2u : 3u; }

// Where the position and the displacement of vertex i stand in `placement`, counted in vectors of four.
const uint slot_vectors = 2u;  // of each vertex in a slot
FN uint position_at(uint slot, uint vertex_count, uint i) { return slot_vectors * slot * vertex_count + i; }
FN uint displacement_at(uint slot, uint vertex_count, uint i) { return (slot_vectors * slot + 1u) * vertex_count + i; }
// slot_of_stage() is the slot that a stage reads, slot_of_force() the one that a stage of a splitting reads after its first kick.
// slot_after_stage() is the one that either writes for the next stage.
FN uint slot_of_stage(uint stage) { return stage == 0u ? start_slot : 1u + (stage & 1u); }
FN uint slot_of_force(uint stage) { return 1u + (stage & 1u); }
FN uint slot_after_stage(uint stage) { return 1u + ((stage + 1u) & 1u); }

// Where the k-th vertex of triangle t stands in `triangle`, and where the corners of node n's box stand in `node_box`.
FN uint corner_of(uint t, uint k) { return 3u * t + k; }
FN uint lower_of(uint n) { return 2u * n; }
FN uint upper_of(uint n) { return 2u * n + 1u; }

// `cage` has two boxes a vertex, of three pairs of numbers each: lower.xy, lower.z and upper.x, upper.yz. `triangle_around` has four numbers a triangle: one for each edge, and one of its own.
FN uint cage_of(uint i) { return 6u * i; }
FN uint way_box_of(uint i) { return 6u * i + 3u; }
FN uint across_edge_of(uint t, uint k) { return 4u * t + k; }
FN uint owned_features_of(uint t) { return 4u * t + 3u; }
// Marks the second triangle of a pair in `triangle_pair` if the boxes of the expected ways meet, too.
const uint ways_meet = 1u << 31;

// The `tableau` of a method with stages has a row for each stage but the first, and one for the step's end. A row holds these pairs:
// - c, and what is left of the velocity at the step's start
// - weights of the stage before, for position (times h^2) and velocity (times h)
// - the weight of the row's own stage in the velocity at the end (times h), and its reciprocal. Zeros if rounding is not cancelled.
// - weights of earlier stages in turn, with zeros up to a multiple of four
const uint first_earlier_weight = 3u;
FN uint tableau_row_size(uint stage_count) { return first_earlier_weight + ((stage_count + 3u) & ~3u); }

const uint tableau_size = 1024u;  // of all tableaus together: room for one of 29 stages

// The `tableau` of a splitting has two rows a stage. The first holds its kick and drift [s], the second the time covered by then [s].
const uint splitting_row_size = 2u;

// `error_weight` has four numbers a stage: its weights in position and velocity for the first estimate, then for the second.
// `error_scale` has two numbers a body: 1 / r [1/m], then 1 / (r omega) [s/m]. PaceLimits says what r and omega are.
FN uint error_weights_of(uint stage) { return 4u * stage; }
FN uint error_scales_of(uint b) { return 2u * b; }

SHARED_END
#endif
