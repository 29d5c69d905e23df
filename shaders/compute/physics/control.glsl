// The simulation's clock and its counters.
#ifndef CONTROL_GLSL
#define CONTROL_GLSL
#include "language.glsl"
SHARED_BEGIN

// Values of the parameter `triangle_test`. The scene's TriangleTest has the same ones.
const uint certified_test = 0u;
const uint moller_test = 1u;

const uint group_size = 64u;  // threads in a work group of main.comp, and of most in groups.comp
const uint max_groups = 65535u;  // in a dispatch: what OpenGL guarantees

// What is counted in each step and summed over the run.
const uint nodes_refitted = 0u;
const uint node_tests = 1u;  // tests of two nodes' boxes, or without trees of two triangles' boxes
const uint triangle_tests = 2u;
const uint contact_pairs = 3u;
const uint reverted_vertices = 4u;
const uint body_pairs_lost = 5u;     // near pairs beyond the list's capacity
const uint body_pairs_skipped = 6u;  // the bodies' boxes are apart, so the pair needs no further work
const uint trees_refitted = 7u;      // a body without a partner keeps its old boxes
const uint pairs_beyond_capacity = 8u;  // leaf pairs that the list had no room for, so that the trees were descended twice
const uint unsettled_contacts = 9u;     // that still changed in the last round of a kick
const uint quiet_steps_made = 10u;      // several of them at once
const uint counter_count = 11u;

struct Control {
  double time_step;        // of the step being made [s], 0 if the step is empty or was undone
  double time_left;        // from its start to the target, if a tolerance governs steps [s]
  uint step;               // the step being made, from 1
  uint non_finite_step;    // 0: none so far
  uint non_finite_vertex;  // the first one, or no_vertex
  uint contact_steps;      // steps with a contact
  uint contact_pairs_max;  // most triangle pairs in one step
  uint near_pair_count;    // body pairs whose boxes overlap, this step
  uint treelet_pair_count;  // pairs of treelets whose boxes overlap, this step (can exceed the list's capacity)
  uint leaf_pair_count;    // pairs of leaves whose boxes overlap, this step (can exceed the list's capacity)
  uint count[counter_count];       // this step's, by the names above
  uint total_low[counter_count];   // of all steps before: 64 bits in two halves
  uint total_high[counter_count];
  uint padding;
};

FN uint groups_for(uint item_count) { return (item_count + group_size - 1u) / group_size; }

SHARED_END
#endif
