// 256 threads for each pair of bodies that are near: each takes one of 16 subtrees of either tree and descends both together,
// down to pairs of triangles whose boxes overlap. They are listed for test_pairs; where the list is full, tested here.
#include "../physics/control.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
WRITE(0, Controls, Control, control)
READ(1, NearPairs, uvec2, near_pair)
READ(2, Nodes, uvec4, node)
READ(3, NodeBoxes, vec4, node_box)
READ(4, Triangles, uint, triangle)
READ(5, WorldPositions, vec4, world_position)
WRITE(6, Candidates, uvec2, candidate)  // places of two triangles in leaf order
WRITE(7, Marks, uint, mark)             // the latest step in which a vertex touched another body
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, first_position)
PARAMETER(2, uint, triangle_test)
PARAMETER(3, uint, candidate_capacity)
#include "parts/box_of_triangle.glsl"
#include "parts/mark_contact.glsl"

// The node at descent_depth on the path whose turns are the bits of `path`; a leaf above that depth belongs to the path of zeros.
uint start_node(uint root, uint path) {
  uint n = root;
  for (uint depth = 0u; depth < descent_depth; ++depth) {
    if (node[n].x == 0u) return path == 0u ? n : no_node;
    n = node[n].x + (path & 1u);
    path >>= 1u;
  }
  return n;
}

Box box_of_node(uint n) {
  Box box;
  box.lower = vec3(node_box[2u * n]);
  box.upper = vec3(node_box[2u * n + 1u]);
  return box;
}

void list_candidate(uint first, uint second) {
  uint at = atomicAdd(control[0].candidate_count, 1u);
  if (at < candidate_capacity) {
    candidate[at] = uvec2(first, second);
    atomicMax(control[0].test_groups[0], at / group_size + 1u);
    return;
  }
  atomicAdd(control[0].count[pairs_beyond_capacity], 1u);
  mark_contact(first, second);
}

void pair_leaves(uint a, uint b) {
  for (uint s = node[a].z; s < node[a].w; ++s) {
    Box box = box_of_triangle(s);
    for (uint t = node[b].z; t < node[b].w; ++t)
      if (overlaps(box, box_of_triangle(t))) list_candidate(s, t);
  }
}

// The wider node opens first; a leaf never does.
bool opens_first(uint a, uint b, Box box_a, Box box_b) {
  if (node[b].x == 0u) return true;
  if (node[a].x == 0u) return false;
  vec3 size_a = box_a.upper - box_a.lower;
  vec3 size_b = box_b.upper - box_b.lower;
  return (size_a.x + size_a.y) + size_a.z >= (size_b.x + size_b.y) + size_b.z;
}

// Returns how many pairs of nodes it tested.
uint descend(uvec2 start) {
  uvec2 stack[130];  // a descent opens one node at a time and pushes two: at most the depths of both trees, 64 each, and one
  int top = 0;
  stack[0] = start;
  uint tests = 0u;
  while (top >= 0) {
    uvec2 at = stack[top--];
    Box box_a = box_of_node(at.x);
    Box box_b = box_of_node(at.y);
    ++tests;
    if (!overlaps(box_a, box_b)) continue;
    if (node[at.x].x == 0u && node[at.y].x == 0u) {
      pair_leaves(at.x, at.y);
    } else if (opens_first(at.x, at.y, box_a, box_b)) {
      stack[++top] = uvec2(node[at.x].x, at.y);
      stack[++top] = uvec2(node[at.x].x + 1u, at.y);
    } else {
      stack[++top] = uvec2(at.x, node[at.y].x);
      stack[++top] = uvec2(at.x, node[at.y].x + 1u);
    }
  }
  return tests;
}

void find_pairs(uint item) {
  uint tests = 0u;
  for (uint k = item / descent_threads; k < control[0].near_pair_count; k += pairs_at_once(descent_threads)) {
    uvec2 start = uvec2(start_node(near_pair[k].x, item & 15u), start_node(near_pair[k].y, (item >> 4u) & 15u));
    if (start.x != no_node && start.y != no_node) tests += descend(start);
  }
  if (tests != 0u) atomicAdd(control[0].count[node_tests], tests);
}
