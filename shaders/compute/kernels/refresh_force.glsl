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

struct Pending {
  bool nothing;
};

Pending before_force(uint i, uint k, IN(Share) s) {
  Pending p;
  p.nothing = true;
  return p;
}

struct Damping {  // it does not damp
  bool nothing;
};

Damping damping_by(IN(Share) s, double force_squared) {
  Damping d;
  d.nothing = true;
  return d;
}

double after_force(uint i, uint k, IN(Share) s, double spring_force, IN(Damping) d, IN(Pending) p) {
  kept_force[force_of(i) + k] = spring_force;
  return double(0);
}

bool settles() { return false; }
void settle(uint i, uint k, IN(Share) s, IN(dvec3) position) {}
