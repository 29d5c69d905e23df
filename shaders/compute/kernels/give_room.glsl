// One thread gives one body room of its own before quiet steps, for responses that look at where steps end, and where no two bodies touch.
// Bodies do not meet as long as each stays in its room.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/quiet.glsl"
READ(control)
READ(status)
READ(body)
READ(motion)
READ(pose)
READ(body_box)
WRITE(quiet_steps)
WRITE(quiet_body)
PARAMETER(uint, body_count)
PARAMETER(uint, searches)  // 0: no two bodies touch
#include "parts/box_of_body.glsl"
#include "parts/is_steady.glsl"
#include "parts/tell_start.glsl"

const float endless = 1e38f;

// The largest distance on any axis; below 0 if they overlap.
float between(Box a, Box b) {
  vec3 apart = max(a.lower - b.upper, b.lower - a.upper);
  return max(apart.x, max(apart.y, apart.z));
}

// Two bodies share what is between them, but for what rounding might take.
float room_around(uint b) {
  Box box = box_of_body(b);
  float room = endless;
  for (uint other = 0u; other < body_count; ++other)
    if (other != b) room = min(room, 0.499f * between(box, box_of_body(other)));
  vec3 farthest = max(abs(box.lower), abs(box.upper));
  return room - 1e-5f * max(farthest.x, max(farthest.y, farthest.z));
}

bool moves(uint b) { return status[b].activity == moving && !is_still(status[b]); }

void give_room(uint b) {
  if (ATOMIC_LOAD(quiet_steps[0].end) == 0u) return;
  float room = searches != 0u && moves(b) ? room_around(b) : endless;
  bool is_quiet = is_steady(status[b]) && room > 0.0f && control[0].non_finite_vertex == no_vertex;
  if (!is_quiet) atomicMin(quiet_steps[0].end, 0u);
  Box box = box_of_body(b);
  for (uint k = 0u; k < 3u; ++k) {
    quiet_body[b].bounds.lower[k] = searches != 0u ? box.lower[int(k)] - room : -endless;
    quiet_body[b].bounds.upper[k] = searches != 0u ? box.upper[int(k)] + room : endless;
  }
  quiet_body[b].frame_changes = 0u;
  tell_start(b);
}
