// One thread serves one contact in one round of a kick. It finds the impulse that its velocity asks for, with all impulses of the round
// before, and adds it to its vertices. All threads share the list of contacts in strides.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/contact.glsl"
#include "../physics/contact/exact_sum.glsl"
#include "../physics/contact/surface.glsl"
WRITE(control)
READ(rest_position)
READ(surface)
READ(start)
READ(contact_vertex)
READ_AS(contact, real4, contact_row)
WRITE_AS(contact_impulse, real4, impulse_row)
READ(contact_weight)
READ(contact_list)
WRITE(impulse_sum)
PARAMETER(uint, vertex_count)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, contacts_at_once)
PARAMETER(uint, kick_round)
PARAMETER(double, least_speed)
PARAMETER(double, heaviest_vertex)
#include "parts/impulse_sums.glsl"

double inverse_mass_of(uint i) { return surface[uint(rest_position[i].w)].inverse_mass; }

// With the impulses of the rounds so far [m/s].
dvec3 velocity_of_vertex(uint i, double of_quantum) {
  return LOAD3(start, start_velocity_of(i)) + (inverse_mass_of(i) * of_quantum) * impulse_on(buffer_of(kick_round), i);
}

void add_impulse(uint i, dvec3 quanta) {
  uint at = impulse_sum_of(buffer_of(kick_round + 1u), vertex_count, i);
  for (uint k = 0u; k < 3u; ++k) ADD_EXACTLY(impulse_sum[at + k], quanta[int(k)])
}

// What resists the contact, if every vertex shares its mass among its contacts [1/kg].
real inverse_mass_of_contact(uvec4 who, real4 weight) {
  double sum = double(0);
  for (int k = 0; k < 4; ++k)
    if (who[k] != no_vertex) sum += double(abs(weight[k])) * double(contact_weight[who[k]]) * double(weight_unit()) * inverse_mass_of(who[k]);
  return real(sum);
}

dvec3 rounded(dvec3 v) { return dvec3(floor(v.x + double(0.5)), floor(v.y + double(0.5)), floor(v.z + double(0.5))); }

// Of the contact's points against each other [m/s]. Differences are taken before they are rounded.
real3 relative_velocity(uvec4 who, real4 weight, double of_quantum) {
  dvec3 first = velocity_of_vertex(who.x, of_quantum);
  if (who.y == no_vertex) return real3(first);  // against a ground
  return weight.y * real3(velocity_of_vertex(who.y, of_quantum) - first) +
         weight.z * real3(velocity_of_vertex(who.z, of_quantum) - first) +
         weight.w * real3(velocity_of_vertex(who.w, of_quantum) - first);
}

void solve(uint c, double of_quantum) {
  uvec4 who = contact_vertex[c];
  real4 normal_row = contact_row[contact_rows * c], weight = contact_row[contact_rows * c + 1u],
        goal_row = contact_row[contact_rows * c + 2u];
  real resistance = inverse_mass_of_contact(who, weight);
  if (!(resistance > real(0))) return;  // between immovable bodies
  real3 velocity = relative_velocity(who, weight, of_quantum);
  real4 impulse = next_impulse(impulse_row[c], normal_row, goal_row, velocity, real(1) / resistance);
  impulse_row[c] = impulse;
  if (kick_round + 1u == kick_rounds && impulse.x > real(0)) atomicAdd(control[0].count[contact_pairs], 1u);
  for (int k = 0; k < 4; ++k)
    if (who[k] != no_vertex) clear_impulse(buffer_of(kick_round + 2u), who[k]);
  if (impulse.x == real(0)) return;
  dvec3 total = (dvec3(real3(impulse.x * real3(normal_row))) + dvec3(real3(impulse.y, impulse.z, impulse.w))) / of_quantum;
  if (who.y == no_vertex) {
    add_impulse(who.x, rounded(total));
    return;
  }
  dvec3 of_y = rounded(double(weight.y) * total), of_z = rounded(double(weight.z) * total), of_w = rounded(double(weight.w) * total);
  add_impulse(who.x, -(of_y + of_z + of_w));
  add_impulse(who.y, of_y);
  add_impulse(who.z, of_z);
  add_impulse(who.w, of_w);
}

void solve_contacts(uint item) {
  uint count = min(contact_list[0].contact_count, contact_capacity);
  double of_quantum = quantum();
  for (uint c = item; c < count; c += contacts_at_once) solve(c, of_quantum);
}
