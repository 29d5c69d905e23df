// One thread serves one body at a step's start, when the step's length is known. It finds where the body's path leads in the step, if it
// has one. That is the body's flight, which proofs leave alone or stop as a whole. A body that its path leaves where it is has none.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/path.glsl"
READ(control)
READ(step_parts)
WRITE(status)
READ(path)
READ(path_key)
WRITE(path_state)
WRITE(cluster)
PARAMETER(uint, body_count)
#include "parts/point_on_path.glsl"

void follow_paths(uint b) {
  if (status[b].activity != scripted) return;
  double h = next_part(step_parts[0], control[0].time_left), per_second = h > double(0) ? ratio(double(1), h) : double(0);
  double time = path_state[b].time + path_state[b].pace * h;
  PathPoint now = path_state[b].now, next = point_on_path(path[b], time);
  dvec3 velocity = per_second * (LOAD3(next.centre, 0u) - LOAD3(now.centre, 0u));
  dvec3 spin = (double(2) * per_second) * half_turn_between(quaternion_of(now), quaternion_of(next));
  path_state[b].next = next;
  path_state[b].next_time = time;
  if (velocity == dvec3(0) && spin == dvec3(0))
    cluster[b].cannot_fly = 1u;
  else
    status[b].disturbed = 1u;
  cluster[b].motion = rigid_motion_of(LOAD3(now.centre, 0u), velocity, spin);
  cluster[b].first = b;
  cluster[b].moves_as_one = 1u;
  ATOMIC_STORE(cluster[body_count].moves_as_one, 1u);
}
