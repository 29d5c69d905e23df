// What a body can reach in a step. Bodies whose reaches are apart have nothing to do with each other. Needs the arrays `surface`,
// `body_box`, `body_motion`, `step_parts` and `status`.
PARAMETER(double, gravity_size)  // [m/s^2]
#include "box_of_body.glsl"

// How much further than expected a body may go [m]. In a step h forces within it move a vertex by (h omega)^2 times what it is out of
// place, which is hardly more than half of the body's size, now or at rest. In the first step gravity is not expected yet.
double play_of(uint b, IN(Box) box) {
  vec3 size = box.upper - box.lower;
  double h = step_parts[0].full, step_omega = h * surface[b].frequency;
  double by_forces = step_omega * step_omega * max(surface[b].diameter, double(max(size.x, max(size.y, size.z))));
  return max(surface[b].edge, by_forces + h * h * gravity_size);
}

// Twice the expected way, because bodies must not come near each other in the next step, either. It is rounded outward by this part.
Box grown_to_reach(uint b, Box places, IN(Box) velocity, float rounding) {
  float play = float(play_of(b, places)), two_steps = float(double(2) * step_parts[0].full);
  vec3 below = two_steps * max(-velocity.lower, vec3(0)) + play, above = two_steps * max(velocity.upper, vec3(0)) + play;
  vec3 slack = (max(abs(places.lower), abs(places.upper)) + max(below, above)) * rounding;
  places.lower -= below + slack;
  places.upper += above + slack;
  return places;
}

Box reach_box_of(uint b) {
  Box box = box_of_body(b);
  return status[b].activity == immovable ? box : grown_to_reach(b, box, box_of_bits(body_motion[b]), 4.8e-7f);
}
