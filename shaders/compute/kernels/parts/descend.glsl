// descend_trees() takes some pairs of subtrees, one of either tree of two near bodies. It descends both of a pair together, down to pairs
// of leaves whose boxes overlap, and hands these to found_leaves(). Many threads serve one pair of bodies.
PARAMETER(uint, node_count)  // of all trees

Box box_of_node(uint n) {
  Box box;
  box.lower = vec3(node_box[lower_of(n)]);
  box.upper = vec3(node_box[upper_of(n)]);
  return box;
}

// The wider node opens first. A leaf never opens.
bool opens_first(uvec4 a, uvec4 b, Box box_a, Box box_b) {
  if (b.x == 0u) return true;
  if (a.x == 0u) return false;
  vec3 size_a = box_a.upper - box_a.lower;
  vec3 size_b = box_b.upper - box_b.lower;
  return (size_a.x + size_a.y) + size_a.z >= (size_b.x + size_b.y) + size_b.z;
}

bool nodes_overlap(uvec2 pair) { return overlaps(box_of_node(pair.x), box_of_node(pair.y)); }

// Starts from two nodes that overlap. Returns how many pairs of nodes it tested, these among them.
uint descend(uvec2 roots) {
  uvec2 stack[130];  // a descent opens one node and pushes two, so it needs at most the depths of both trees, 64 each, and one
  int top = 0;
  stack[0] = roots;
  uint tests = 0u;
  while (top >= 0) {
    uvec2 at = stack[top--];
    uvec4 a = node[at.x], b = node[at.y];
    Box box_a = box_of_node(at.x);
    Box box_b = box_of_node(at.y);
    ++tests;
    if (!overlaps(box_a, box_b)) continue;
    if (a.x == 0u && b.x == 0u) {
      found_leaves(at);
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

// So many threads share the near pairs. For each body `node` says, behind the nodes of all trees, where the body's subtrees begin there and
// how many they are. Returns how many pairs of nodes this thread tested.
uint descend_trees(uint item, uint threads) {
  uint count = control[0].near_pair_count, of_a_pair = max(threads / max(count, 1u), 1u), stride = threads / of_a_pair;
  uint tests = 0u, pair = item / of_a_pair;
  if (pair >= stride) return 0u;  // left over
  for (; pair < count; pair += stride) {
    uvec4 first = node[node_count + near_pair[pair].x], second = node[node_count + near_pair[pair].y];
    for (uint s = item % of_a_pair; s < first.y * second.y; s += of_a_pair) {
      uvec2 roots = uvec2(node[first.x + s % first.y].x, node[second.x + s / first.y].x);
      tests += nodes_overlap(roots) ? descend(roots) : 1u;
    }
  }
  return tests;
}
