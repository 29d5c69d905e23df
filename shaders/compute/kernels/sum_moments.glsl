// A group kernel. It sums the moments of some vertices of a body with internal damping. It runs before a stage.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/rigid_motion.glsl"
READ(body)
READ(status)
READ_AS(placement, real4, placed)
READ(motion)
READ(acceleration)
READ(moment_part)
WRITE(moment)
PARAMETER(uint, vertex_count)
PARAMETER(uint, slot)
PARAMETER(uint, half_index)
PARAMETER(uint, stage_index)
#include "parts/stage_motion.glsl"
#include "parts/moments_of_threads.glsl"

void sum_moments(uint item) {
  uvec4 part = moment_part[item];
  if (status[part.x].deformed == 0u || is_still(status[part.x])) return;
  uint first = body[part.x].first_vertex;
  dvec3 first_place = place_at_stage(first), first_velocity = velocity_at_stage(first);
  Moments sum = no_moments();
  for (uint i = part.y + THREAD; i < part.z; i += THREADS)
    add_vertex(sum, place_at_stage(i) - first_place, velocity_at_stage(i) - first_velocity);
  keep_moments(sum);
  MEET
  for (uint k = THREAD; k < moments_numbers; k += THREADS) moment[moments_numbers * item + k] = sum_over_threads(k);
}
