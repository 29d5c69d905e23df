// One thread serves one body, before the step's length is known. A scripted body may go faster later in the step than at its start, or again
// after it has waited. This extends the box of the velocities that its vertices are expected to have.
#include "../physics/body.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
#include "../physics/path.glsl"
READ(status)
READ(surface)
READ(step_parts)
READ(path)
READ(path_key)
READ(path_state)
WRITE(body_motion)
#include "parts/point_on_path.glsl"

const uint looks = 4u;  // evenly spaced over the scene's step, the last one at its end

void bound_paths(uint b) {
  if (status[b].activity != scripted) return;
  for (uint look = 1u; look <= looks; ++look) {
    double time = path_state[b].time + path_state[b].pace * step_parts[0].full * (double(look) / double(looks));
    PathPoint p = point_on_path(path[b], time);
    dvec3 velocity = path_state[b].pace * LOAD3(p.velocity, 0u);
    double turning = path_state[b].pace * length(LOAD3(p.spin, 0u)) * (double(0.5) * surface[b].diameter);
    for (uint k = 0u; k < 3u; ++k) {
      uint lower = ordered_bits(float(velocity[int(k)] - turning)), upper = ordered_bits(float(velocity[int(k)] + turning));
      LOWER_TO(body_motion[b].lower[k], lower)
      RAISE_TO(body_motion[b].upper[k], upper)
    }
  }
}
