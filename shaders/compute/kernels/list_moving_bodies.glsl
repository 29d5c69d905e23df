// One thread serves one share before quiet steps. It lists the body if it moves and this is its first share. Where too many bodies move
// that may meet, no step is quiet.
#include "../physics/body.glsl"
#include "../physics/quiet.glsl"
READ(share)
READ(status)
WRITE(quiet_steps)
WRITE(quiet_body)
PARAMETER(uint, may_meet)  // 0: no two bodies can touch

void list_moving_bodies(uint k) {
  uint b = share[k].body_index;
  bool is_first = share[k].first_vertex == share[k].body.first_vertex;
  if (!is_first || status[b].activity != moving || is_still(status[b])) return;
  uint at = atomicAdd(quiet_steps[0].moving_bodies, 1u);
  quiet_body[at].moving_share = k;
  if (may_meet != 0u && at >= most_quiet_bodies) atomicMin(quiet_steps[0].end, 0u);
}
