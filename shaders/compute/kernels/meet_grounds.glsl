// One thread finds the contacts of one vertex with grounds.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/contact.glsl"
READ(control)
READ(rest_position)
READ(status)
READ(surface)
READ(ground)
READ(start)
READ(expected)
READ(surplus)
READ(last_cut)
PARAMETER(uint, vertex_count)
PARAMETER(uint, ground_count)
#include "parts/add_contact.glsl"

void meet_ground(uint i, uint g) {
  Surface s = surface[uint(rest_position[i].w)];
  dvec3 normal = LOAD3(ground[g].normal, 0u), velocity = LOAD3(start, start_velocity_of(i));
  dvec3 surplus_now = LOAD3(expected, force_of(i)) - velocity;
  Approach a;
  a.gap = real(gap_above(ground[g], s));
  a.time_step = real(control[0].time_step);
  a.slowest = real(fastest_return(s.frequency));
  a.elasticity = real(mean_of_pair(s.elasticity, ground[g].elasticity));
  Course c;
  c.distance = real(dot(normal, LOAD3(start, start_position_of(i))) - ground[g].offset);
  c.velocity = real(dot(normal, velocity));
  c.surplus = real(dot(normal, surplus_now));
  c.was = c.velocity - real(contact_list[0].last_part * dot(normal, LOAD3(surplus, end_surplus_of(vertex_count, i))));
  c.was_cut = last_cut[i] != 0u;
  if (!is_near(c, a)) return;
  real3 goal = across(real3(normal), real3(-surplus_now - velocity));
  list_contact(uvec4(i, no_vertex, no_vertex, no_vertex), real4(1, 0, 0, g), real3(normal), c, a, goal,
               real(mean_of_pair(s.friction, ground[g].friction)));
}

void meet_grounds(uint i) {
  if (control[0].non_finite_step != 0u || control[0].time_step == double(0)) return;
  uint b = uint(rest_position[i].w);
  if (surface[b].inverse_mass == double(0) || is_asleep(status[b])) return;
  for (uint g = 0u; g < ground_count; ++g) meet_ground(i, g);
}
