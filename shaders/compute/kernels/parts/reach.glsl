// What a body can reach in a step. Bodies whose reaches are apart have nothing to do with each other. Needs the arrays `surface`,
// `body_box`, `body_motion` and `step_parts`.
#include "box_of_body.glsl"

// The most that a component of an expected velocity can be [m/s].
double fastest_along(uint b, uint k) {
  return double(max(abs(from_ordered_bits(body_motion[b].lower[k])), abs(from_ordered_bits(body_motion[b].upper[k]))));
}

// How far the body's vertices may be expected to go [m].
double way_of(uint b) {
  return step_parts[0].full * length(dvec3(fastest_along(b, 0u), fastest_along(b, 1u), fastest_along(b, 2u)));
}

// How much further than expected it may go [m]. In a step h forces within a body move a vertex by (h omega)^2 times what it is out of
// place, which is hardly more than half of the body's size, now or at rest.
double play_of(uint b, IN(Box) box) {
  vec3 size = box.upper - box.lower;
  double step_omega = step_parts[0].full * surface[b].frequency;
  return max(surface[b].edge, step_omega * step_omega * max(surface[b].diameter, double(max(size.x, max(size.y, size.z)))));
}

// Twice the expected way, because bodies must not come near each other in the next step, either. Rounded outward.
Box reach_box_of(uint b) {
  Box box = box_of_body(b);
  if (surface[b].inverse_mass == double(0)) return box;
  vec3 far = vec3(float(double(2) * way_of(b) + play_of(b, box)));
  vec3 slack = (max(abs(box.lower), abs(box.upper)) + far) * 2.4e-7f;
  box.lower -= far + slack;
  box.upper += far + slack;
  return box;
}
