// A force kernel of stages. A splitting method has one stage for each force. A stage kicks by the sum of the springs, then drifts on or
// ends the step.
#include "../physics/body.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/control.glsl"
#include "../physics/damping.glsl"
#include "../physics/forces/spring.glsl"
#include "../physics/layout.glsl"
READ(share)
READ(control)
WRITE(status)
READ(rest_position)
WRITE(kept_force)
WRITE_AS(world_position, float, world_coordinate)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, damping_law)
PARAMETER(double, parts_of)  // [s] the tableau is for steps of this length, if they can fall into parts; else 0
#include "parts/stages.glsl"
#include "parts/force_kernel.glsl"
#include "parts/place.glsl"
#include "parts/all_force.glsl"
#include "parts/end_step.glsl"
#include "parts/kick.glsl"
#include "parts/part_of_step.glsl"

bool runs(IN(Share) s) { return !halted(s); }

#ifdef TILE
#define HAS_FIRST_KICK
#include "parts/first_kick.glsl"
uint first_stage(IN(Share) s, bool sums) { return 0u; }
#ifdef QUIET
#include "parts/kept_before.glsl"
bool makes_first_kick() { return true; }
bool refreshes(IN(Share) s) { return false; }
void end_refresh(IN(Share) s) {}
#else
PARAMETER(uint, with_first_kick)  // 0: other kernels have summed stale forces again, and made the first kick
bool makes_first_kick() { return with_first_kick != 0u; }
bool refreshes(IN(Share) s) { return makes_first_kick() && status[s.body_index].force_stale != 0u; }
void end_refresh(IN(Share) s) { status[s.body_index].force_stale = 0u; }
#endif
#endif
uint placement_slot() { return stage_index == refresh_stage ? start_slot : slot_of_force(stage_index); }

// These read the tableau's two rows for this stage.
double kick_time() { return part_of_step() * tableau[splitting_row_size * stage_index].x; }     // [s]
double drift_time() { return part_of_step() * tableau[splitting_row_size * stage_index].y; }    // of the next drift, zero at the end [s]
double elapsed() { return part_of_step() * tableau[splitting_row_size * stage_index + 1u].x; }  // all drifts of the step up to it [s]

struct Pending {
  double rest;
  double gravity;
  double displacement;  // after the drifts so far
  double velocity;
  double reference;  // the next placement is relative to this displacement [m]
};

Pending before_force(uint i, uint k, IN(Share) s) {
  Pending p;
  if (stage_index == refresh_stage) return p;
  uint after = in_half(other_half(from_half), vertex_count, i), first = s.body.first_vertex;
  p.rest = double(rest_position[i][int(k)]);
  p.gravity = gravity_of(s.body_index, k);
  p.displacement = motion[displacement_of(after) + k];
  p.velocity = motion[velocity_of(after) + k];
  EXACT double reference = first_displacement(first, k) + elapsed() * first_velocity(first, k);
  p.reference = reference;
  return p;
}

struct Damping {
  Decay of_kick;
};

Damping damping_by(IN(Share) s, double force_squared) {
  Damping d;
  d.of_kick.keep = d.of_kick.gain = double(1);
  if (stage_index != refresh_stage) d.of_kick = decay_in_kick(s.body, force_squared, kick_time());
  return d;
}

double after_force(uint i, uint k, IN(Share) s, double spring_force, IN(Damping) d, IN(Pending) p) {
  kept_force[force_of(i) + k] = spring_force;
  if (stage_index == refresh_stage) return double(0);
  double velocity = kicked(s.body, p.gravity, all_force(i, k, spring_force), d.of_kick, p.velocity, kick_time());
  EXACT double displacement = p.displacement + drift_time() * velocity;
  place(is_last() ? start_slot : slot_after_stage(stage_index), i, k, s.body.inverse_unit, p.rest, displacement - p.reference);
  end_step(i, k, s, displacement, velocity, p.reference);
  return p.rest + displacement;
}

bool settles() { return is_last(); }
void settle(uint i, uint k, IN(Share) s, IN(dvec3) position) { end_in_world(i, k, s.body_index, position); }
