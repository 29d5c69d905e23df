// descend_trees() descends pairs of treelets, one of either tree of two near bodies, down to pairs of leaves whose boxes overlap.
// It hands these to found_leaves(). A tree that is compared with itself gives each two leaves once, and each leaf with itself. Groups share
// the pairs out between them. The threads of a group have one list of pairs of nodes that overlap and are not opened yet, and open the
// latest ones, a pair each.
READ(near_pair)
READ(tree)
READ(treelet)
READ(treelet_pair)
PARAMETER(uint, search_groups)
PARAMETER(uint, treelet_pair_capacity)
NEAR(uvec2, open_pair, most_open_pairs)
NEAR(uint, open_count, 1)

// A node that is compared with itself opens as the first of the pair. Then each of its children meets the node, and of that those children
// that are not before it.
bool is_child(uint n, uvec4 of) { return of.x <= n && n < of.y; }

// Which of the two opens: the wider one, but never a leaf.
bool first_opens(uvec2 pair, uvec4 a, uvec4 b, IN(PaddedBox) box_a, IN(PaddedBox) box_b) {
  if (is_child(pair.x, b)) return false;
  if (b.x == 0u) return true;
  if (a.x == 0u) return false;
  vec4 size_a = box_a.upper - box_a.lower;
  vec4 size_b = box_b.upper - box_b.lower;
  return (size_a.x + size_a.y) + size_a.z >= (size_b.x + size_b.y) + size_b.z;
}

// Takes a pair of nodes whose boxes overlap.
void meet_nodes(uvec2 pair, bool are_leaves) {
  if (are_leaves) {
    found_leaves(pair);
  } else {
    NEAR_ADD(at, open_count[0], 1u)
    open_pair[at] = pair;
  }
}

// Returns how many pairs of nodes it tested.
uint open_nodes(uvec2 pair) {
  uvec4 a = node[pair.x], b = node[pair.y];
  PaddedBox box_a = box_of_node(pair.x), box_b = box_of_node(pair.y);
  bool opens_a = first_opens(pair, a, b, box_a, box_b), stays_leaf = (opens_a ? b.x : a.x) == 0u;
  uint first = opens_a ? a.x : max(b.x, is_child(pair.x, b) ? pair.x : 0u), end = opens_a ? a.y : b.y;
  PaddedBox stays = box_a;
  if (opens_a) stays = box_b;
  uint near = 0u;  // bits of children: a processor foresees how many there are better than which
  for (uint n = first; n < end; ++n) near |= (overlaps(box_of_node(n), stays) ? 1u : 0u) << (n - first);
  for (; near != 0u; near &= near - 1u) {
    uint n = first + uint(findLSB(near));
    meet_nodes(opens_a ? uvec2(n, pair.y) : uvec2(pair.x, n), stays_leaf && node[n].x == 0u);
  }
  return end - first;
}

// Opens all pairs of the list, and what comes of them.
uint open_all() {
  uint tests = 0u;
  for (;;) {
    MEET
    uint count = open_count[0];
    if (count == 0u) break;
    uint taken = pairs_to_open(count, THREADS);
    uvec2 pair = open_pair[count - 1u - min(THREAD, taken - 1u)];
    MEET
    if (THREAD == 0u) open_count[0] = count - taken;
    MEET
    if (THREAD < taken) tests += open_nodes(pair);
  }
  MEET  // all have seen that the list is empty
  return tests;
}

uint meet_treelets(uint s, uint t, bool overlap) {
  uvec2 roots = uvec2(treelet[s].first_node, treelet[t].first_node);
  if (overlap || overlaps(box_of_node(roots.x), box_of_node(roots.y)))
    meet_nodes(roots, node[roots.x].x == 0u && node[roots.y].x == 0u);
  return overlap ? 0u : 1u;
}

// Of a hybrid refit, if their list was long enough.
uint descend_listed(uint group) {
  uint tests = 0u, count = control[0].treelet_pair_count;
  for (uint first = group; first < count; first += search_groups * THREADS) {
    uint k = first + THREAD * search_groups;
    if (k < count) tests += meet_treelets(treelet_pair[k].x, treelet_pair[k].y, true);
    tests += open_all();
  }
  return tests;
}

uint descend_all(uint group) {
  uint count = control[0].near_pair_count, of_a_pair = max(search_groups / max(count, 1u), 1u),
       stride = search_groups / of_a_pair;
  uint tests = 0u, pair = group / of_a_pair;
  if (pair >= stride) return 0u;  // left over
  for (; pair < count; pair += stride) {
    uvec4 a = tree[near_pair[pair].x], b = tree[near_pair[pair].y];
    for (uint first = group % of_a_pair; first < a.y * b.y; first += of_a_pair * THREADS) {
      uint k = first + THREAD * of_a_pair;
      uint s = a.x + k % a.y, t = b.x + k / a.y;
      if (k < a.y * b.y && (a.x != b.x || s <= t)) tests += meet_treelets(s, t, false);
      tests += open_all();
    }
  }
  return tests;
}

// Returns how many pairs of nodes this thread tested.
uint descend_trees(uint group) {
  if (THREAD == 0u) open_count[0] = 0u;
  MEET
  if (treelet_pair_capacity == 0u || control[0].treelet_pair_count > treelet_pair_capacity) return descend_all(group);
  return descend_listed(group);
}
