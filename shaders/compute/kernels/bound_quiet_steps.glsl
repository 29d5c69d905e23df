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
READ(tree)
READ(quiet_steps)
WRITE(quiet_body)
PARAMETER(double, largest_body)  // radius at rest [m]
#include "parts/tell_start.glsl"
#include "parts/quiet_region.glsl"

// Less than what bodies that meet no others have (limit_step.glsl, expect_motion.glsl).
double room_of(uint b) {
  Box point;
  point.lower = point.upper = vec3(0);
  return min(double(0.8) * play_of(b, point), double(900) * surface[b].edge);
}

const float most_surprise = 0.02f;  // of a vertex whose body may meet itself, in edges
const float endless = 1e30f;

// Its triangles and their winding. A vertex may leave the bounds in the last step, so positions in the world round by at most as much as at
// twice the distance of the farthest corner.
QuietStar star_of(uint b, IN(Box) places) {
  dvec3 farthest = max(abs(dvec3(places.lower)), abs(dvec3(places.upper)));
  double far = rounded_from(double(2) * sum_of_sizes(farthest), sum_of_sizes(LOAD3(pose[b].origin, 0u)), largest_body);
  QuietStar star;
  star.first_triangle = tree[b].z;
  star.end_triangle = surface[b].meets_itself != 0u ? tree[b].w : tree[b].z;
  star.winding = float(surface[b].winding);
  star.edge = float(surface[b].edge);
  star.rounding = float(margin_of_rounding(double(0), double(0), far));
  return star;
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
  quiet_body[b].bounds.surprise = surface[b].meets_itself != 0u ? most_surprise * float(surface[b].edge) : endless;
  quiet_body[b].star = star_of(b, places);
  tell_start(b);
  quiet_body[b].frame_changes = 0u;
}
