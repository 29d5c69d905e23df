// One thread serves one share before quiet steps, and lists it if its body moves. If there are more than `most_shares`, no step is
// quiet.
#include "../physics/body.glsl"
#include "../physics/quiet.glsl"
READ(share)
READ(status)
WRITE(quiet_steps)
WRITE(quiet_body)
PARAMETER(uint, most_shares)

void list_moving_shares(uint k) {
  uint b = share[k].body_index;
  if (status[b].activity != moving || is_still(status[b])) return;
  uint at = atomicAdd(quiet_steps[0].moving_shares, 1u);
  if (at < most_shares)
    quiet_body[at].moving_share = k;
  else
    atomicMin(quiet_steps[0].end, 0u);
}
