// Lists the pairs of bodies whose boxes overlap, if one of the two may move, and each body that may touch itself as a pair of its own. All
// later collision work is for listed pairs alone.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/collision/grid.glsl"
WRITE(control)
READ(tree)
READ(body_box)
WRITE(status)
READ(grid_list)
READ(grid_entry)
READ(grid_level)
WRITE(near_pair)
PARAMETER(uint, body_count)
PARAMETER(uint, pair_count)  // of bodies that might touch
PARAMETER(uint, near_pair_capacity)
#include "parts/box_to_touch.glsl"

Box box_to_meet(uint b) { return box_to_touch(b); }

const uint no_place = ~0u;
uint place_of_pair() {
  uint at = atomicAdd(control[0].near_pair_count, 1u);
  if (at < near_pair_capacity) return at;
  atomicAdd(control[0].near_pair_count, ~0u);  // minus one
  atomicAdd(control[0].count[body_pairs_lost], 1u);
  return no_place;
}

void meet(uint a, uint b) {
  Status first = status[a], second = status[b];  // at once, as in box_to_touch()
  if ((first.activity != moving && second.activity != moving) || (is_still(first) && is_still(second))) return;
  uint at = place_of_pair();
  if (at == no_place) return;
  near_pair[at] = uvec4(a, b, atomicExchange(status[a].first_pair, at + 1u), atomicExchange(status[b].first_pair, at + 1u));
  atomicAdd(control[0].count[body_pairs_skipped], ~0u);
  ATOMIC_STORE(status[a].partner_step, control[0].step);
  ATOMIC_STORE(status[b].partner_step, control[0].step);
}

#include "parts/each_pair.glsl"

// Such a pair links to no others.
void meet_itself(uint b) {
  if (status[b].folds == 0u || status[b].activity != moving || is_still(status[b]) || tree[b].y == 0u) return;
  uint at = place_of_pair();
  if (at == no_place) return;
  near_pair[at] = uvec4(b, b, 0, 0);
  ATOMIC_STORE(status[b].partner_step, control[0].step);
}

void pair_bodies(uint item) {
  bool is_made = control[0].time_step > double(0) && control[0].non_finite_step == 0u;
  if (item == 0u && is_made) atomicAdd(control[0].count[body_pairs_skipped], pair_count);
  uint b = body_of(item);
  if (b != no_body) meet_itself(b);
  visit_pairs(item);
}
