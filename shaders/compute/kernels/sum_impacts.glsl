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
READ(status)
READ(surface)
READ(step_parts)
READ(contact_vertex)
READ_AS(contact, real4, contact_row)
READ_AS(contact_impulse, real4, impulse_row)
READ(contact_list)
SHARED_WRITE(impact_partner)
WRITE(impact_sum)
WRITE(impact_part)
PARAMETER(uint, body_count)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(uint, contacts_at_once)
PARAMETER(double, least_speed)
#include "parts/full_lists.glsl"
#include "parts/impact_pair.glsl"

// Where the keeper has its impact with the partner, from now on if there was none. Places that are taken stay so in this kernel, so that
// all threads come to the same one. If there is none left, it returns no_place.
uint find_impact(uint keeper, uint partner) {
  uint wanted = partner + 1u;
  for (uint k = 0u; k < impact_places; ++k) {
    uint at = impact_at(keeper, (partner + k) % impact_places);
    if (ATOMIC_LOAD(impact_partner[at]) == wanted) return at;
  }
  for (uint k = 0u; k < impact_places; ++k) {
    uint at = impact_at(keeper, (partner + k) % impact_places), before = atomicCompSwap(impact_partner[at], 0u, wanted);
    if (before == 0u || before == wanted) return at;
  }
  return no_place;
}

bool is_scripted(uint b) { return b < body_count && status[b].activity == scripted; }

void sum_impact(uint c) {
  uvec4 who = contact_vertex[c];
  real4 weight = contact_row[contact_rows * c + 1u], impulse = impulse_row[c];
  if (impulse.x == real(0)) return;
  uint a = uint(rest_position[who.x].w), b = body_count;
  if (who.y != no_vertex) b = uint(rest_position[weight.y * weight.x > real(0) ? who.z : who.y].w);
  if (a == b) return;                                // a body has no impacts with itself
  if (is_scripted(a) || is_scripted(b)) return;  // its velocity is its path's, so no impact is restored against it
  uint keeper = keeper_of_impact(a, b);
  real side = (weight.x > real(0)) == (a == keeper) ? real(1) : real(-1);
  real3 given = impulse.x * real3(contact_row[contact_rows * c]) + real3(impulse.y, impulse.z, impulse.w);
  dvec3 all = dvec3(real3(side * given)) / impact_unit(a, b);
  ATOMIC_STORE(impact_part[latest_of_all(body_count)], step_parts[0].parts + 1u);
  uint at = find_impact(keeper, keeper == a ? b : a);
  if (at == no_place) {
    ATOMIC_STORE(impact_part[lack_of_places_of(keeper, body_count)], 1u);
    return;
  }
  for (uint k = 0u; k < 3u; ++k) ADD_EXACTLY(impact_sum[3u * at + k], nearest_whole(all[int(k)]))
  ATOMIC_STORE(impact_part[at], step_parts[0].parts + 1u);
}

void sum_impacts(uint item) {
  if (lists_are_full() || control[0].time_step == double(0)) return;
  for (uint c = item; c < contact_list[0].contact_count; c += contacts_at_once) sum_impact(c);
}
