// What a body may reach within some quiet steps. Needs the arrays `surface`, `body_box`, `body_motion`, `step_parts` and `status`.
#include "reach.glsl"

// Bounds of its places [m]. They need not hold: steps are quiet until a vertex leaves them.
Box place_bound(uint b, uint steps) {
  Box box = box_of_body(b);
  if (status[b].activity == immovable || is_idle(status[b])) return box;
  Box velocity = box_of_bits(body_motion[b]);
  float time = float(steps) * float(step_parts[0].full), play = float(surface[b].edge) + 0.5f * float(gravity_size) * time * time;
  box.lower += time * min(velocity.lower, vec3(0)) - play;
  box.upper += time * max(velocity.upper, vec3(0)) + play;
  return box;
}

// Bounds of the velocities that its vertices are expected to have [m/s].
Box velocity_bound(uint b, uint steps) {
  Box velocity = box_of_bits(body_motion[b]);
  if (status[b].activity == immovable || is_idle(status[b])) return velocity;
  float time = float(steps) * float(step_parts[0].full);
  vec3 range = velocity.upper - velocity.lower;
  float more = float(surface[b].edge / (double(4) * step_parts[0].full)) + float(gravity_size) * time +
               0.25f * max(range.x, max(range.y, range.z));
  velocity.lower -= more;
  velocity.upper += more;
  return velocity;
}

// All that it reaches from these places with these velocities. Rounded further, because steps round places and velocities anew.
Box quiet_region(uint b, uint steps) {
  Box places = place_bound(b, steps);
  return status[b].activity == immovable ? places : grown_to_reach(b, places, velocity_bound(b, steps), 2e-6f);
}
