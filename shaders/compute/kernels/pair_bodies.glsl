// One thread compares the boxes of two bodies, and lists the pair if they overlap. All later collision work is for listed pairs alone.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/collision/box.glsl"
WRITE(control)
READ(tree)
READ(body_box)
READ(status)
WRITE(near_pair)
WRITE(partner_step)
PARAMETER(uint, body_count)

Box box_of(uint b) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = from_ordered_bits(body_box[b].lower[k]);
    box.upper[k] = from_ordered_bits(body_box[b].upper[k]);
  }
  return box;
}

void pair_bodies(uint item) {
  uint a = item / body_count;
  uint b = item % body_count;
  if (a >= b || tree[a].y == 0u || tree[b].y == 0u) return;
  if (status[a].activity != moving && status[b].activity != moving) return;
  if (status[a].non_finite_vertex != no_vertex || status[b].non_finite_vertex != no_vertex) return;
  if (!overlaps(box_of(a), box_of(b))) {
    atomicAdd(control[0].count[body_pairs_skipped], 1u);
    return;
  }
  atomicAdd(control[0].count[body_pairs_near], 1u);
  uint at = atomicAdd(control[0].near_pair_count, 1u);
  near_pair[at] = uvec2(a, b);
  ATOMIC_STORE(partner_step[a], control[0].step);
  ATOMIC_STORE(partner_step[b], control[0].step);
}
