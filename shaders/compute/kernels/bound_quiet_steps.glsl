// One thread serves one body before quiet steps. It sets the bounds within which they are quiet.
#include "../physics/body.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
#include "../physics/quiet.glsl"
READ(surface)
READ_AS(place_box, BoxBits, body_box)
READ(body_motion)
READ(step_parts)
READ(status)
READ(body)
READ(motion)
READ(pose)
READ(quiet_steps)
WRITE(quiet_body)
#include "parts/tell_start.glsl"
#include "parts/quiet_region.glsl"

// Less than what bodies that meet no others have (limit_step.glsl, expect_motion.glsl).
double room_of(uint b) {
  Box point;
  point.lower = point.upper = vec3(0);
  return min(double(0.8) * play_of(b, point), double(900) * surface[b].edge);
}

void bound_quiet_steps(uint b) {
  Box places = place_bound(b, quiet_steps[0].end), velocities = velocity_bound(b, quiet_steps[0].end);
  for (uint k = 0u; k < 3u; ++k) {
    quiet_body[b].bounds.lower[k] = places.lower[int(k)];
    quiet_body[b].bounds.upper[k] = places.upper[int(k)];
    quiet_body[b].bounds.least_velocity[k] = velocities.lower[int(k)];
    quiet_body[b].bounds.most_velocity[k] = velocities.upper[int(k)];
  }
  quiet_body[b].bounds.room = float(room_of(b));
  tell_start(b);
  quiet_body[b].frame_changes = 0u;
}
