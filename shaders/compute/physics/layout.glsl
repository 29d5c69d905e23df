// Where things stand in arrays that hold several numbers an item. See physics/arrays.glsl for the arrays.
#ifndef LAYOUT_GLSL
#define LAYOUT_GLSL
#include "language.glsl"
SHARED_BEGIN

// Motions and world positions have two halves, before a step and after it. This is a vertex's place in either array.
FN uint in_half(uint half_index, uint vertex_count, uint i) { return half_index * vertex_count + i; }
FN uint other_half(uint half_index) { return 1u - half_index; }

// `motion`: by a vertex's place, the first of three.
FN uint displacement_of(uint place) { return 6u * place; }
FN uint velocity_of(uint place) { return 6u * place + 3u; }

// `kept_force` and `acceleration`: the first of three.
FN uint force_of(uint i) { return 3u * i; }
FN uint acceleration_of(uint stage, uint vertex_count, uint i) { return 3u * (stage * vertex_count + i); }

// `placement` has three slots of all vertices, of which stages use the first two in turn. A fourth notes what rounding has done.
const uint start_slot = 2u;  // the step's start, from the end of the step before
const uint slot_count = 3u;
const uint rounding_slot = 3u;

// Where a vertex's position stands among the placements, in vectors of four, and its displacement.
FN uint position_at(uint slot, uint vertex_count, uint i) { return 2u * slot * vertex_count + i; }
FN uint displacement_at(uint slot, uint vertex_count, uint i) { return (2u * slot + 1u) * vertex_count + i; }
// The slot that a stage reads, a splitting's after its first kick, and the one that either writes for the next.
FN uint slot_of_stage(uint stage) { return stage == 0u ? start_slot : stage & 1u; }
FN uint slot_of_force(uint stage) { return stage & 1u; }
FN uint slot_after_stage(uint stage) { return (stage + 1u) & 1u; }

// `triangle`: its k-th vertex. `node_box`: the corners of a node's box.
FN uint corner_of(uint t, uint k) { return 3u * t + k; }
FN uint lower_of(uint n) { return 2u * n; }
FN uint upper_of(uint n) { return 2u * n + 1u; }

// `tableau` of a method with stages: a row for each stage but the first, and one for the step's end. First c, and what is left of the
// velocity at the step's start; then weights for position (h^2) and velocity (h) of the stage before; then that stage's own weight in
// the velocity at the end, over h, and its reciprocal, or zero where rounding is not cancelled; then weights of earlier stages in turn,
// with zeros up to a multiple of four.
const uint first_earlier_weight = 3u;
FN uint tableau_row_size(uint stage_count) { return first_earlier_weight + ((stage_count + 3u) & ~3u); }

const uint tableau_size = 1024u;  // of all tableaus together: room for one of 29 stages

// `tableau` of a splitting: kick and drift of a stage [s], then the time covered by then [s].
const uint splitting_row_size = 2u;

// `error_weight`, by stage: in position and velocity of the first estimate, then of the second. `error_scale`, by body: 1 / r [1/m],
// then 1 / (r omega) [s/m].
FN uint error_weights_of(uint stage) { return 4u * stage; }
FN uint error_scales_of(uint b) { return 2u * b; }

SHARED_END
#endif
