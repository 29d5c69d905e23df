// A part of a body's tree that is refitted and searched as one: a node with few enough triangles and all nodes below it. They stand level
// by level, from first_node on.
#ifndef TREELET_GLSL
#define TREELET_GLSL
#include "../language.glsl"
SHARED_BEGIN

struct Treelet {
  uint body;
  uint first_node;  // its root
  uint end_node;
  uint end_inner;  // one past its last node with children, or first_node
  uint levels;
  uint first_vertex;  // of its triangles' vertices, each once, in `treelet_vertex`
  uint end_vertex;
};

const uint most_children = 8u;
const uint most_splits = 64u;  // from a root to a leaf

// A group that descends trees keeps pairs of nodes that are not opened yet, and has room for so many. It opens several at once while that
// leaves room enough to open one after the other. A path goes down at most 64 splits in each tree, which are 22 nodes with 8 children. So
// 44 pairs are opened on the way, and each leaves 7 more. Nodes with fewer children leave less.
const uint most_open_pairs = 896u;
const uint most_open_alone = (most_children - 1u) * 2u * ((most_splits + 2u) / 3u);

// How many of `count` pairs a group of so many threads may open at once.
FN uint pairs_to_open(uint count, uint threads) {
  uint room = most_open_pairs - most_open_alone, at_once = count < room ? (room - count) / (most_children - 1u) : 0u;
  return max(min(min(count, threads), at_once), 1u);
}

SHARED_END
#endif
