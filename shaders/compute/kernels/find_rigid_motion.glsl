// A group kernel. It finds the rigid motion of one body with internal damping. It runs before a stage and after sum_moments.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/rigid_motion.glsl"
READ(body)
READ(status)
READ_AS(placement, real4, placed)
READ(motion)
READ(acceleration)
READ(moment_range)
READ(moment)
WRITE(rigid_motion)
PARAMETER(uint, vertex_count)
PARAMETER(uint, slot)
PARAMETER(uint, half_index)
PARAMETER(uint, stage_index)
#include "parts/stage_motion.glsl"
#include "parts/moments_of_threads.glsl"

// If no vertex moves relative to another, all have the first one's velocity, bit for bit. Damping is then exactly zero.
void find_rigid_motion(uint b) {
  uvec2 range = moment_range[b];
  if (range.y == 0u || is_still(status[b])) return;
  uint first = body[b].first_vertex;
  dvec3 first_place = place_at_stage(first), first_velocity = velocity_at_stage(first);
  if (status[b].deformed == 0u) {
    if (THREAD == 0u) rigid_motion[b] = rigid_motion_of(first_place, first_velocity, dvec3(0));
    return;
  }
  Moments sum = no_moments();
  for (uint k = THREAD; k < range.y; k += THREADS) {
    Moments of_part = no_moments();
    LOAD_MOMENTS(of_part, moment, moments_numbers * (range.x + k))
    add_moments(sum, of_part);
  }
  keep_moments(sum);
  MEET
  for (uint k = THREAD; k < moments_numbers; k += THREADS) of_threads[k] = sum_over_threads(k);  // which nobody else reads
  MEET
  if (THREAD != 0u) return;
  LOAD_MOMENTS(sum, of_threads, 0u)
  rigid_motion[b] = rigid_motion_with(sum, body[b].vertex_count, first_place, first_velocity);
}
