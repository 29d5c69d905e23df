// A kernel in rounds. One thread serves one contact in one round of a kick. It finds the impulse that its velocity asks for, with all
// impulses of the round before, and adds it to its vertices.
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
WRITE_AS(contact, real4, contact_row)
WRITE_AS(contact_impulse, real4, impulse_row)
READ(contact_weight)
SHARED_WRITE(contact_list)
SHARED_WRITE(impulse_sum)
PARAMETER(uint, vertex_count)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(double, least_speed)
PARAMETER(double, heaviest_vertex)
#include "parts/full_lists.glsl"
#include "parts/impulse_sums.glsl"

uint items_in_a_round() { return lists_are_full() ? 0u : contact_list[0].contact_count; }
uint rounds_at_most() { return kick_rounds; }
bool goes_on(uint kick_round) { return kick_round < kick_rounds; }

double inverse_mass_of(uint i) { return surface[uint(rest_position[i].w)].inverse_mass; }

// Returns row 3. Every vertex shares its mass among its contacts.
real4 resistance_of(uvec4 who, real4 weight, double of_quantum) {
  double first = double(0), second = double(0), sum = double(0);
  for (int k = 0; k < 4; ++k) {
    if (who[k] == no_vertex) continue;
    double inverse_mass = inverse_mass_of(who[k]);
    if (weight[k] > real(0)) first = of_quantum * inverse_mass;
    if (weight[k] < real(0)) second = of_quantum * inverse_mass;
    sum += double(abs(weight[k])) * double(contact_weight[who[k]]) * double(weight_unit()) * inverse_mass;
  }
  return real4(real(first), real(second), sum > double(0) ? real(double(1) / sum) : real(0), real(0));
}

// With the impulses of the rounds so far [m/s]. `of_quantum` is what a quantum changes it by.
dvec3 velocity_of_vertex(uint i, real of_quantum, uint kick_round) {
  return LOAD3(start, start_velocity_of(i)) + double(of_quantum) * impulse_on(buffer_of(kick_round), i);
}

// Of the contact's points against each other [m/s]. Differences are taken before they are rounded.
real3 relative_velocity(uvec4 who, real4 weight, real4 resistance, uint kick_round) {
  dvec3 first = velocity_of_vertex(who.x, weight.x > real(0) ? resistance.x : resistance.y, kick_round);
  if (who.y == no_vertex) return real3(first);  // against a ground
  real3 y = real3(velocity_of_vertex(who.y, weight.y > real(0) ? resistance.x : resistance.y, kick_round) - first);
  real3 z = real3(velocity_of_vertex(who.z, weight.z > real(0) ? resistance.x : resistance.y, kick_round) - first);
  real3 w = real3(velocity_of_vertex(who.w, weight.w > real(0) ? resistance.x : resistance.y, kick_round) - first);
  return weight.y * y + weight.z * z + weight.w * w;
}

void add_impulse(uint i, dvec3 quanta, uint kick_round) {
  uint at = impulse_sum_of(buffer_of(kick_round + 1u), vertex_count, i);
  for (uint k = 0u; k < 3u; ++k) ADD_EXACTLY(impulse_sum[at + k], quanta[int(k)])
}

dvec3 nearest(dvec3 v) { return dvec3(nearest_whole(v.x), nearest_whole(v.y), nearest_whole(v.z)); }

// The fourth vertex of a contact gets what the others leave, so that their sum is zero.
void spread_impulse(uvec4 who, real4 weight, dvec3 total, uint kick_round) {
  if (who.y == no_vertex) {
    add_impulse(who.x, nearest(total), kick_round);
    return;
  }
  dvec3 of_y = nearest(double(weight.y) * total), of_z = nearest(double(weight.z) * total), of_w = nearest(double(weight.w) * total);
  add_impulse(who.x, -(of_y + of_z + of_w), kick_round);
  add_impulse(who.y, of_y, kick_round);
  add_impulse(who.z, of_z, kick_round);
  add_impulse(who.w, of_w, kick_round);
}

void solve_contacts(uint c, uint kick_round) {
  uvec4 who = contact_vertex[c];
  real4 normal_row = contact_row[contact_rows * c], weight = contact_row[contact_rows * c + 1u],
        goal_row = contact_row[contact_rows * c + 2u];
  double of_quantum = quantum();
  if (kick_round == 0u) contact_row[contact_rows * c + 3u] = resistance_of(who, weight, of_quantum);
  real4 resistance = contact_row[contact_rows * c + 3u];
  if (resistance.z == real(0)) return;  // between immovable bodies
  real3 velocity = relative_velocity(who, weight, resistance, kick_round);
  real4 impulse = next_impulse(impulse_row[c], normal_row, goal_row, velocity, resistance.z);
  impulse_row[c] = impulse;
  if (kick_round + 1u == kick_rounds && impulse.x > real(0)) atomicAdd(control[0].count[contact_pairs], 1u);
  for (int k = 0; k < 4; ++k)
    if (who[k] != no_vertex) clear_impulse(buffer_of(kick_round + 2u), who[k]);
  if (impulse.x == real(0)) return;
  dvec3 total = (dvec3(real3(impulse.x * real3(normal_row))) + dvec3(real3(impulse.y, impulse.z, impulse.w))) / of_quantum;
  spread_impulse(who, weight, total, kick_round);
}
