// A force kernel that sums springs for kernels whose sums are given. Shares of these sums have a unit force of -1, so what comes to
// after_force() is the sum itself. The kernels that finish the vertices count it.
#include "../physics/body.glsl"
#include "../physics/forces/spring.glsl"
#include "../physics/layout.glsl"
READ_AS(sum_share, Share, share)
READ(status)
READ_AS(placement, real4, placed)
WRITE_AS(spring_sum, double, own_sum)
PARAMETER(uint, vertex_count)
PARAMETER(uint, slot)
PARAMETER(uint, only_stale)  // 1: only where the spring forces kept from the step before do not hold
#define COUNTS_NOTHING
#include "parts/force_kernel.glsl"
#undef COUNTS_NOTHING

bool runs(IN(Share) s) { return !halted(s) && (only_stale == 0u || status[s.body_index].force_stale != 0u); }
uint placement_slot() { return slot; }

#include "parts/force_alone.glsl"

double after_force(uint i, uint k, IN(Share) s, double sum, IN(Damping) d, IN(Pending) p) {
  own_sum[force_of(i) + k] = sum;
  return double(0);
}
