// A force kernel, once a force of a splitting method: kick by the sum of the springs, then drift on, or end the step.
#include "../physics/body.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/damping.glsl"
#include "../physics/forces/spring.glsl"
READ(0, Shares, Share, share)
WRITE(1, Frames, Frame, frame)
READ(2, RestPositions, vec4, rest_position)
READ(3, PlacementsBefore, real4, placed)
WRITE(4, Placements, real, placement)
WRITE(5, Forces, double, force)
WRITE(6, Motions, double, motion)
WRITE(7, WorldPositions, float, world_position)
PARAMETER(0, uint, vertex_count)
PARAMETER(1, uint, from_half)
PARAMETER(2, uint, damping_law)
PARAMETER(3, double, kick_time)   // [s]
PARAMETER(4, double, drift_time)  // [s]; zero: the step ends here
PARAMETER(5, double, elapsed)     // time of the step that the drifts so far and the next one cover [s]
PARAMETER(6, uint, stage_index)
#include "parts/force_kernel.glsl"
#include "parts/place.glsl"
#include "parts/end_step.glsl"
#include "parts/kick.glsl"

bool runs(IN(Share) s) { return !halted(s); }
uint placement_slot() { return stage_index & 1u; }

bool is_last() { return drift_time == double(0); }

struct Pending {
  double rest;
  double gravity;
  double displacement;  // after the drifts so far
  double velocity;
  double reference;  // that the next placement is relative to
};

Pending before_force(uint i, uint k, IN(Share) s) {
  uint after = 6u * ((1u - from_half) * vertex_count + i) + k, first = 6u * (from_half * vertex_count + s.body.first_vertex) + k;
  Pending p;
  p.rest = double(rest_position[i][int(k)]);
  p.gravity = frame[s.body_index].gravity[k];
  p.displacement = motion[after];
  p.velocity = motion[after + 3u];
  p.reference = motion[first] + elapsed * motion[first + 3u];
  return p;
}

double after_force(uint i, uint k, IN(Share) s, double spring_force, double force_squared, IN(Pending) p) {
  force[3u * i + k] = spring_force;
  double velocity = kicked(s.body, p.gravity, spring_force, force_squared, p.velocity, kick_time);
  double displacement = p.displacement + drift_time * velocity;
  place(is_last() ? start_slot : (stage_index + 1u) & 1u, i, k, s.body.inverse_unit, p.rest, displacement - p.reference);
  end_step(i, k, s, displacement, velocity, p.reference);
  return p.rest + displacement;
}

bool settles() { return is_last(); }
void settle(uint i, uint k, IN(Share) s, IN(dvec3) position) { end_in_world(i, k, s.body_index, position); }
