// A kernel in rounds. One thread serves one contact in one round of a kick. It finds the impulse that its velocity asks for, with all
// impulses of the round before, and adds it to its vertices. In the first round contacts at rest add what they had in the last step: the
// other rounds alone would leave a little of every impulse out, and what rests would creep. After the last of these rounds it kicks those
// of its vertices that no other contact has kicked yet, and adds up what the contact did to energy.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/contact.glsl"
#include "../physics/contact/exact_sum.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
WRITE(control)
READ(pose)
READ(rest_position)
READ(surface)
WRITE(status)
WRITE(motion)
READ(step_parts)
WRITE(pressed)
WRITE(contact_sum)
READ(start)
READ(contact_vertex)
WRITE_AS(contact, real4, contact_row)
WRITE_AS(contact_impulse, real4, impulse_row)
SHARED_WRITE(contact_weight)
SHARED_WRITE(contact_list)
SHARED_WRITE(impulse_sum)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(double, least_speed)
PARAMETER(double, heaviest_vertex)
#include "parts/full_lists.glsl"
#include "parts/impulse_sums.glsl"

uint items_in_a_round() { return lists_are_full() ? 0u : contact_list[0].contact_count; }
uint rounds_at_most() { return most_kick_rounds + 1u; }

// The last round follows one in which all contacts had settled. While it runs, nobody notes a contact that has not, so all threads find the
// same answer. In any other round the note only grows, which leaves the answer no.
bool is_last(uint kick_round) {
  return kick_round + 1u >= fewest_kick_rounds &&
         (ATOMIC_LOAD(contact_list[0].unsettled_round) + 2u <= kick_round || kick_round + 1u == most_kick_rounds);
}
bool is_kick(uint kick_round) { return kick_round > 0u && is_last(kick_round - 1u); }

// If no contact presses in the first two rounds, none does in the others.
bool goes_on(uint kick_round) { return kick_round == 1u ? contact_list[0].presses != 0u : !is_kick(kick_round); }

double inverse_mass_of(uint i) { return surface[uint(rest_position[i].w)].inverse_mass; }

// Returns row 3. Every vertex shares its mass among its contacts.
real4 resistance_of(uvec4 who, real4 weight, real settled, double of_quantum) {
  double first = double(0), second = double(0), sum = double(0);
  for (int k = 0; k < 4; ++k) {
    if (who[k] == no_vertex) continue;
    double inverse_mass = inverse_mass_of(who[k]);
    if (weight[k] > real(0)) first = of_quantum * inverse_mass;
    if (weight[k] < real(0)) second = of_quantum * inverse_mass;
    sum += double(abs(weight[k])) * double(contact_weight[who[k]]) * double(weight_unit()) * inverse_mass;
  }
  real mass = sum > double(0) ? real(double(1) / sum) : real(0);
  return real4(real(first), real(second), mass, mass * settled);
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

dvec3 nearest(dvec3 v) { return dvec3(nearest_whole(v.x), nearest_whole(v.y), nearest_whole(v.z)); }

// Adds an impulse to a vertex's sum [quanta]. All low halves are added before the high ones.
#define ADD_LOW_HALVES(before, to, quanta)                                                                         \
  uvec3 before = uvec3(ADD_LOW_HALF(impulse_sum[to], (quanta).x), ADD_LOW_HALF(impulse_sum[(to) + 1u], (quanta).y), \
                       ADD_LOW_HALF(impulse_sum[(to) + 2u], (quanta).z));
#define ADD_HIGH_HALVES(before, to, quanta)                       \
  {                                                               \
    ADD_HIGH_HALF(impulse_sum[to], (quanta).x, (before).x)        \
    ADD_HIGH_HALF(impulse_sum[(to) + 1u], (quanta).y, (before).y) \
    ADD_HIGH_HALF(impulse_sum[(to) + 2u], (quanta).z, (before).z) \
  }

// Adds an impulse on the one vertex of a contact with a ground.
void push_off(uint i, dvec3 quanta, uint sums) {
  uint to = impulse_sum_of(sums, vertex_count, i);
  ADD_LOW_HALVES(before, to, quanta)
  ADD_HIGH_HALVES(before, to, quanta)
}

// Adds an impulse to four vertices. The first gets what the others leave, so that their sum is zero. There are no loops and no arrays:
// compilers for GPUs would wait for each addition in turn.
void push_apart(uvec4 who, real4 weight, dvec3 total, uint sums) {
  dvec3 of_y = nearest(double(weight.y) * total), of_z = nearest(double(weight.z) * total), of_w = nearest(double(weight.w) * total);
  dvec3 of_x = -(of_y + of_z + of_w);
  uint to_x = impulse_sum_of(sums, vertex_count, who.x), to_y = impulse_sum_of(sums, vertex_count, who.y),
       to_z = impulse_sum_of(sums, vertex_count, who.z), to_w = impulse_sum_of(sums, vertex_count, who.w);
  ADD_LOW_HALVES(before_x, to_x, of_x)
  ADD_LOW_HALVES(before_y, to_y, of_y)
  ADD_LOW_HALVES(before_z, to_z, of_z)
  ADD_LOW_HALVES(before_w, to_w, of_w)
  ADD_HIGH_HALVES(before_x, to_x, of_x)
  ADD_HIGH_HALVES(before_y, to_y, of_y)
  ADD_HIGH_HALVES(before_z, to_z, of_z)
  ADD_HIGH_HALVES(before_w, to_w, of_w)
}

void push(uint c, uint kick_round) {
  uvec4 who = contact_vertex[c];
  real4 normal_row = contact_row[contact_rows * c], weight = contact_row[contact_rows * c + 1u],
        goal_row = contact_row[contact_rows * c + 2u];
  double of_quantum = quantum();
  real4 resistance = contact_row[contact_rows * c + 3u];
  if (kick_round == 0u) {
    resistance = resistance_of(who, weight, resistance.w, of_quantum);
    contact_row[contact_rows * c + 3u] = resistance;
  }
  if (resistance.z == real(0)) return;  // between immovable bodies
  real4 impulse = impulse_row[c], ahead = impulse;
  bool ends = is_last(kick_round);
  if (kick_round > 0u) {
    real4 had = contact_row[contact_rows * c + 4u], before = impulse;
    impulse = next_impulse(had, normal_row, goal_row, relative_velocity(who, weight, resistance, kick_round), resistance.z);
    bool turns = dot(had - impulse, impulse - before) > real(0);  // the sums went too far ahead
    ahead = impulse;
    if (!ends && !turns) ahead += momentum_after(kick_round) * (impulse - before);
    if (!ends && length(impulse - had) > resistance.w) ATOMIC_STORE(contact_list[0].unsettled_round, kick_round);
  }
  contact_row[contact_rows * c + 4u] = ahead;
  impulse_row[c] = impulse;
  if (ends && impulse.x > real(0)) atomicAdd(control[0].count[contact_pairs], 1u);
  clear_impulse(buffer_of(kick_round + 2u), who.x);
  if (who.y != no_vertex) {
    clear_impulse(buffer_of(kick_round + 2u), who.y);
    clear_impulse(buffer_of(kick_round + 2u), who.z);
    clear_impulse(buffer_of(kick_round + 2u), who.w);
  }
  if (ahead == real4(0)) return;
  if (kick_round <= 1u) ATOMIC_STORE(contact_list[0].presses, 1u);
  dvec3 total = (dvec3(real3(ahead.x * real3(normal_row))) + dvec3(real3(ahead.y, ahead.z, ahead.w))) * (double(1) / of_quantum);
  if (who.y == no_vertex)
    push_off(who.x, nearest(total), buffer_of(kick_round + 1u));
  else
    push_apart(who, weight, total, buffer_of(kick_round + 1u));
}

void kick(uint i, uint kick_round) {
  if (i == no_vertex || atomicExchange(contact_weight[i], 0u) == 0u) return;  // another contact has kicked it
  dvec3 quanta = impulse_on(buffer_of(kick_round), i);
  uint b = uint(rest_position[i].w);
  if (quanta == dvec3(0) || surface[b].inverse_mass == double(0)) return;
  uint at = velocity_of(in_half(from_half, vertex_count, i));
  dvec3 velocity = LOAD3(motion, at) + (surface[b].inverse_mass * quantum()) * rotate_back(pose[b], quanta);
  STORE3(motion, at, velocity)
  ATOMIC_STORE(status[b].deformed, 1u);
  ATOMIC_STORE(pressed[b], step_parts[0].parts + 1u);
  for (uint k = 0u; k < 3u; ++k)
    if (quanta[int(k)] != double(0)) ADD_EXACTLY(contact_sum[k], quanta[int(k)])
}

// The mean of the vertex's velocities before and after the kick [m/s].
dvec3 mean_velocity_of(uint i, uint kick_round) {
  return LOAD3(start, start_velocity_of(i)) + (double(0.5) * inverse_mass_of(i) * quantum()) * impulse_on(buffer_of(kick_round), i);
}

// The same of the contact's points against each other.
dvec3 mean_velocity_at(uvec4 who, real4 weight, uint kick_round) {
  dvec3 first = mean_velocity_of(who.x, kick_round);
  if (who.y == no_vertex) return first;  // against a ground
  return double(weight.y) * (mean_velocity_of(who.y, kick_round) - first) +
         double(weight.z) * (mean_velocity_of(who.z, kick_round) - first) +
         double(weight.w) * (mean_velocity_of(who.w, kick_round) - first);
}

void add_energy(uint k, double energy) {
  double whole = nearest_whole(energy / quantum_of_energy());
  if (whole != double(0)) ADD_EXACTLY(contact_sum[k], whole)
}

// An impulse gives as much energy as it would along the mean of the velocities before and after.
void add_work(uint c, uint kick_round) {
  real4 impulse = impulse_row[c], normal_row = contact_row[contact_rows * c];
  if (!(impulse.x > real(0))) return;
  dvec3 mean = mean_velocity_at(contact_vertex[c], contact_row[contact_rows * c + 1u], kick_round);
  double along = double(impulse.x) * dot(dvec3(double(normal_row.x), double(normal_row.y), double(normal_row.z)), mean);
  double across = dot(dvec3(double(impulse.y), double(impulse.z), double(impulse.w)), mean);
  add_energy(along + across > double(0) ? energy_given : energy_taken, abs(along + across));
  add_energy(friction_work, -across);
}

void solve_contacts(uint c, uint kick_round) {
  if (!is_kick(kick_round)) {
    push(c, kick_round);
    return;
  }
  add_work(c, kick_round);
  for (int k = 0; k < 4; ++k) kick(contact_vertex[c][k], kick_round);
}
