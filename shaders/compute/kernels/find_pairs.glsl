// A group kernel. It descends pairs of treelets together, and lists the pairs of leaves whose boxes overlap. Pairs are counted beyond the
// list's end, too. What becomes of a pair is left to another kernel: with a test of triangles in it this one would take twice as long,
// since fewer of its threads would run at once.
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/treelet.glsl"
WRITE(control)
READ(node)
READ(node_box)
WRITE(leaf_pair)
PARAMETER(uint, leaf_pair_capacity)

void found_leaves(uvec2 leaves) { APPEND(leaf_pair, control[0].leaf_pair_count, leaf_pair_capacity, leaves) }

#include "parts/node_boxes.glsl"
#include "parts/descend.glsl"

void find_pairs(uint item) {
  uint tests = descend_trees(item);
  TALLY_UP(control[0].count[node_tests], tests)
}
