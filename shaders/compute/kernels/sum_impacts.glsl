// One thread adds the impulses of some contacts to those of their pairs of bodies. All grounds together are one partner more. It runs if a
// body has a restitution. A step that was undone adds nothing. All threads share the list of contacts in strides.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/contact.glsl"
#include "../physics/contact/exact_sum.glsl"
#include "../physics/contact/impact.glsl"
#include "../physics/contact/parts.glsl"
READ(control)
READ(rest_position)
READ(surface)
READ(step_parts)
READ(contact_vertex)
READ_AS(contact, real4, contact_row)
READ_AS(contact_impulse, real4, impulse_row)
READ(contact_list)
WRITE(impact_sum)
WRITE(impact_part)
PARAMETER(uint, body_count)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(uint, contacts_at_once)
PARAMETER(double, least_speed)
#include "parts/full_lists.glsl"
#include "parts/impact_unit.glsl"

void sum_impact(uint c) {
  uvec4 who = contact_vertex[c];
  real4 weight = contact_row[contact_rows * c + 1u], impulse = impulse_row[c];
  if (impulse.x == real(0)) return;
  uint a = uint(rest_position[who.x].w), b = body_count;
  if (who.y != no_vertex) b = uint(rest_position[weight.y * weight.x > real(0) ? who.z : who.y].w);
  real side = (weight.x > real(0)) == (a < b) ? real(1) : real(-1);  // on the body that comes first
  real3 given = impulse.x * real3(contact_row[contact_rows * c]) + real3(impulse.y, impulse.z, impulse.w);
  dvec3 all = dvec3(real3(side * given)) / impact_unit(a, b);
  uint at = impact_of(min(a, b), max(a, b), body_count);
  for (uint k = 0u; k < 3u; ++k) ADD_EXACTLY(impact_sum[3u * at + k], nearest_whole(all[int(k)]))
  ATOMIC_STORE(impact_part[at], step_parts[0].parts + 1u);
  ATOMIC_STORE(impact_part[impact_count(body_count)], step_parts[0].parts + 1u);
}

void sum_impacts(uint item) {
  if (lists_are_full() || control[0].time_step == double(0)) return;
  for (uint c = item; c < contact_list[0].contact_count; c += contacts_at_once) sum_impact(c);
}
