// Many threads for each pair of bodies that are near: each takes a subtree of either tree and descends both together, down to
// pairs of triangles whose boxes overlap. They are listed for test_pairs; where the list is full, tested here.
#include "../physics/control.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/collision/certified_triangles.glsl"
#include "../physics/collision/moller_triangles.glsl"
WRITE(0, Controls, Control, control)
READ(1, NearPairs, uvec2, near_pair)  // two bodies
READ(2, Nodes, uvec4, node)              // behind the trees: x: the subtrees to start from, by body
READ(3, NodeBoxes, vec4, node_box)
READ(4, Triangles, uint, triangle)
READ(5, WorldPositions, vec4, world_position)
WRITE(6, Candidates, uvec2, candidate)  // places of two triangles in leaf order
WRITE(7, Marks, uint, mark)             // the latest step in which a vertex touched another body
PARAMETER(0, uint, first_position)
PARAMETER(1, uint, triangle_test)
PARAMETER(2, uint, candidate_capacity)
PARAMETER(3, uint, first_start)
PARAMETER(4, uint, start_count)    // subtrees of a body
PARAMETER(5, uint, pairs_at_once)  // threads go on to later pairs in strides of this
#include "parts/box_of_triangle.glsl"
#include "parts/mark_contact.glsl"

Box box_of_node(uint n) {
  Box box;
  box.lower = vec3(node_box[2u * n]);
  box.upper = vec3(node_box[2u * n + 1u]);
  return box;
}

// Lists pairs of four triangles from s on with four from t on, by the bits of `pairs`: of s + q / 4 with t + q % 4.
void list_candidates(uint s, uint t, uint pairs) {
  if (pairs == 0u) return;
  uint at = atomicAdd(control[0].candidate_count, uint(bitCount(pairs)));
  for (uint q = 0u; q < 16u; ++q) {
    if (((pairs >> q) & 1u) == 0u) continue;
    if (at < candidate_capacity) {
      candidate[at] = uvec2(s + q / 4u, t + q % 4u);
    } else {
      atomicAdd(control[0].count[pairs_beyond_capacity], 1u);
      mark_contact(s + q / 4u, t + q % 4u);
    }
    ++at;
  }
}

// A bit for each of four boxes, from t on, that overlaps `box` and is there.
uint overlap_bits(Box box, FourBoxes four, uint t, uint end) {
  return (overlaps(box, four.first) ? 1u : 0u) | (t + 1u < end && overlaps(box, four.second) ? 2u : 0u) |
         (t + 2u < end && overlaps(box, four.third) ? 4u : 0u) | (t + 3u < end && overlaps(box, four.fourth) ? 8u : 0u);
}

void pair_leaves(uvec4 a, uvec4 b) {
  for (uint s = a.z; s < a.w; s += 4u) {
    FourBoxes own = four_boxes(s, a.w);
    for (uint t = b.z; t < b.w; t += 4u) {
      FourBoxes others = four_boxes(t, b.w);
      uint pairs = overlap_bits(own.first, others, t, b.w);
      if (s + 1u < a.w) pairs |= overlap_bits(own.second, others, t, b.w) << 4u;
      if (s + 2u < a.w) pairs |= overlap_bits(own.third, others, t, b.w) << 8u;
      if (s + 3u < a.w) pairs |= overlap_bits(own.fourth, others, t, b.w) << 12u;
      list_candidates(s, t, pairs);
    }
  }
}

// The wider node opens first; a leaf never does.
bool opens_first(uvec4 a, uvec4 b, Box box_a, Box box_b) {
  if (b.x == 0u) return true;
  if (a.x == 0u) return false;
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
    uvec4 a = node[at.x], b = node[at.y];
    Box box_a = box_of_node(at.x);
    Box box_b = box_of_node(at.y);
    ++tests;
    if (!overlaps(box_a, box_b)) continue;
    if (a.x == 0u && b.x == 0u) {
      pair_leaves(a, b);
    } else if (opens_first(a, b, box_a, box_b)) {
      stack[++top] = uvec2(a.x, at.y);
      stack[++top] = uvec2(a.x + 1u, at.y);
    } else {
      stack[++top] = uvec2(at.x, b.x);
      stack[++top] = uvec2(at.x, b.x + 1u);
    }
  }
  return tests;
}

void find_pairs(uint item) {
  uint tests = 0u;
  uint subtree = item % (start_count * start_count);
  for (uint k = item / (start_count * start_count); k < control[0].near_pair_count; k += pairs_at_once) {
    uvec2 start = uvec2(node[first_start + near_pair[k].x * start_count + subtree % start_count].x,
                        node[first_start + near_pair[k].y * start_count + subtree / start_count].x);
    if (start.x != no_node && start.y != no_node) tests += descend(start);
  }
  if (tests != 0u) atomicAdd(control[0].count[node_tests], tests);
}
