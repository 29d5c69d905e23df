// One thread adds the force on one vertex that makes constant damping spare its body's rigid motion. It runs before a stage and after
// find_rigid_motion. Damping by -c v and the force c r, with the rigid motion's velocity r, are -c (v - r) together.
//
// A splitting's kick takes r from its start, but gravity changes r on the way. Of gravity the damped kick leaves the part phi(z)
// (physics/damping.glsl). A force of m (1 / phi(z) - 1) times gravity restores the rest. Forces within a body do not change r. So the
// kick stays exact.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/damping.glsl"
#include "../physics/layout.glsl"
#include "../physics/rigid_motion.glsl"
READ(control)
READ(body)
READ(pose)
READ(rest_position)
READ_AS(placement, real4, placed)
READ(rigid_motion)
WRITE(added_force)
PARAMETER(uint, vertex_count)
PARAMETER(uint, slot)
PARAMETER(uint, is_first)
PARAMETER(double, kick_time)  // [s] of a splitting's kick, 0 for other methods
PARAMETER(double, parts_of)   // [s] this time is for steps of this length, if they can fall into parts; else 0
#include "parts/add_force.glsl"
#include "parts/part_of_step.glsl"

void spare_rigid_motion(uint i) {
  uint b = uint(rest_position[i].w);
  dvec3 velocity = velocity_at(rigid_motion[b], dvec3(real3(placed[position_at(slot, vertex_count, i)])));
  double z = damping_rate(damping_constant, body[b].damping, body[b].inverse_mass, double(0)) * (part_of_step() * kick_time);
  double restored = (double(1) / decay(z).gain - double(1)) / body[b].inverse_mass;
  add_force(i, body[b].damping * velocity + restored * LOAD3(pose[b].gravity, 0u));
}
