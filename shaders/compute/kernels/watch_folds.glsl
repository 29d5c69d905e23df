// One thread serves one triangle at a step's start. It notes whether the surface of a body that meets itself may do so in this step. A star
// does not (physics/contact/star.glsl). Its centre has to have depth to spare below the triangle, because contacts may change how vertices
// move. It bounds the step, too, so that no edge changes by more than a quarter of the body's mean edge.
#include "../physics/body.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/star.glsl"
#include "../physics/contact/surface.glsl"
#include "../physics/layout.glsl"
READ(triangle)
READ(rest_position)
READ(surface)
READ(start)
READ(surplus)
WRITE(step_parts)
READ(place_box)
READ(pose)
READ(body_motion)
WRITE(status)
PARAMETER(double, largest_body)  // radius at rest [m]
#include "parts/bound_step.glsl"
#include "parts/star_centre.glsl"

const double least_depth = double(0.5);  // in edges

// In a whole step [m/s].
dvec3 expected_velocity(uint i) {
  return LOAD3(start, start_velocity_of(i)) + step_parts[0].full * dvec3(LOAD3(surplus, expected_surplus_of(i)));
}

void bound_edges(uint t, uint b) {
  for (uint k = 0u; k < 3u; ++k) {
    uint from = triangle[corner_of(t, k)], to = triangle[corner_of(t, k == 2u ? 0u : k + 1u)];
    bound_speed(length(expected_velocity(to) - expected_velocity(from)), double(0.25) * surface[b].edge);
  }
}

// In the first step it is not known yet what forces do. In a step h they move vertices by (h omega)^2 times the body's size, at most about.
void bound_first_step(uint b) {
  if (step_parts[0].last == double(0) && status[b].deformed != 0u)
    bound_step(sqrt(reach_of_folds() * surface[b].edge / surface[b].diameter) / surface[b].frequency);
}

bool stays_star(uint t, uint b) {
  double whole_step = step_parts[0].full;
  Box velocity = box_of_bits(body_motion[b]);
  dvec3 centre = star_centre(b), centre_later = centre + whole_step * (double(0.5) * (dvec3(velocity.lower) + dvec3(velocity.upper)));
  Facet f;
  for (uint k = 0u; k < 3u; ++k) {
    uint i = triangle[corner_of(t, k)];
    f.start[k] = real3(LOAD3(start, start_position_of(i)) - centre);
    f.end[k] = real3(LOAD3(start, start_position_of(i)) + whole_step * expected_velocity(i) - centre_later);
  }
  real winding = real(surface[b].winding), depth = real(least_depth * surface[b].edge);
  return faces_out(f, winding, rounding_of_places(b, centre)) && is_deep_below(f.start[0], f.start[1], f.start[2], winding, depth) &&
         is_deep_below(f.end[0], f.end[1], f.end[2], winding, depth);
}

void watch_folds(uint t) {
  uint b = uint(rest_position[triangle[corner_of(t, 0u)]].w);
  if (surface[b].meets_itself == 0u) return;
  bool stands = is_still(status[b]);  // so far. Whether something wakes it is found later, and then its pairs are looked at
  if (!stands) bound_edges(t, b);
  if (!stands && stays_star(t, b)) return;
  ATOMIC_STORE(status[b].folds, 1u);
  if (!stands) bound_first_step(b);
}
