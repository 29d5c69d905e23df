// A force kernel that sums the spring forces again if a contact has moved vertices since they were kept.
#include "../physics/body.glsl"
#include "../physics/forces/spring.glsl"
#include "../physics/layout.glsl"
READ(share)
READ(status)
WRITE(tally)
READ_AS(placement, real4, placed)
WRITE(kept_force)
PARAMETER(uint, vertex_count)
#include "parts/force_kernel.glsl"

bool runs(IN(Share) s) { return !halted(s) && status[s.body_index].force_stale != 0u; }
uint placement_slot() { return start_slot; }

#include "parts/force_alone.glsl"

double after_force(uint i, uint k, IN(Share) s, double spring_force, IN(Damping) d, IN(Pending) p) {
  kept_force[force_of(i) + k] = spring_force;
  return double(0);
}
