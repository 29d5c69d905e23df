// One thread serves one body after quiet steps, for contact by impulses. Each of them was one part. What the body was expected to do is
// emptied.
#include "../physics/body.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/quiet.glsl"
READ(quiet_steps)
READ(status)
WRITE(step_parts)
WRITE(body_motion)
WRITE(place_box)

void end_quiet_parts(uint b) {
  uint made = steps_made(quiet_steps[0]);
  if (b == 0u) {
    step_parts[0].parts += made;
    step_parts[0].steps += made;
  }
  for (uint k = 0u; k < 3u; ++k) {
    body_motion[b].lower[k] = 0xffffffffu;
    body_motion[b].upper[k] = 0u;
    if (status[b].calm == at_rest) continue;
    place_box[b].lower[k] = 0xffffffffu;
    place_box[b].upper[k] = 0u;
  }
}
