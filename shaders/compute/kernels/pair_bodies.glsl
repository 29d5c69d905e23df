// One thread for each two bodies: lists the pairs whose boxes overlap. All later collision work is for these alone.
#include "../physics/control.glsl"
#include "../physics/collision/box.glsl"
WRITE(0, Controls, Control, control)
READ(1, Trees, uvec2, tree)             // root and number of leaves of each body
READ(2, BodyBoxes, uint, body_box)
WRITE(3, NearPairs, uvec2, near_pair)   // roots of the two trees
WRITE(4, Partners, uint, partner_step)  // the latest step in which a body had a partner
PARAMETER(0, uint, body_count)
PARAMETER(1, uint, leaf_count)
PARAMETER(2, uint, threads_per_pair)

Box box_of(uint b) {
  Box box;
  box.lower = vec3(from_ordered_bits(body_box[6u * b]), from_ordered_bits(body_box[6u * b + 1u]),
                   from_ordered_bits(body_box[6u * b + 2u]));
  box.upper = vec3(from_ordered_bits(body_box[6u * b + 3u]), from_ordered_bits(body_box[6u * b + 4u]),
                   from_ordered_bits(body_box[6u * b + 5u]));
  return box;
}

void pair_bodies(uint item) {
  uint a = item / body_count;
  uint b = item % body_count;
  if (a >= b || tree[a].y == 0u || tree[b].y == 0u) return;
  if (control[0].non_finite_vertex != no_vertex) return;
  if (!overlaps(box_of(a), box_of(b))) {
    atomicAdd(control[0].count[body_pairs_skipped], 1u);
    return;
  }
  atomicAdd(control[0].count[body_pairs_near], 1u);
  uint at = atomicAdd(control[0].near_pair_count, 1u);
  near_pair[at] = uvec2(tree[a].x, tree[b].x);
  ATOMIC_STORE(partner_step[a], control[0].step);
  ATOMIC_STORE(partner_step[b], control[0].step);
  atomicMax(control[0].refit_groups[0], groups_for(leaf_count));
  atomicMax(control[0].find_groups[0], min(at + 1u, pairs_at_once(threads_per_pair)) * (threads_per_pair / group_size));
}
