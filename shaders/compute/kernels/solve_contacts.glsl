// A kernel in rounds. One thread serves one contact in one round of a kick. It finds the impulse that its velocity asks for, with all
// impulses of the round before, and adds it to its vertices. In the first round contacts at rest add what they had in the last step: the
// other rounds alone would leave a little of every impulse out, and what rests would creep. Rounds first stop points. In one round impulses
// of contacts that bounce grow, and then rounds go on. After the last of these rounds it kicks those of its vertices that no other contact
// has kicked yet, and adds up what the contact did to energy.
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
SHARED_WRITE_AS(impulse_sum, WholeSum, impulse_sum)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(double, least_speed)
#include "parts/full_lists.glsl"
#include "parts/quantum.glsl"
#include "parts/round_sums.glsl"
#include "parts/rouse.glsl"

uint items_in_a_round() { return lists_are_full() ? 0u : contact_list[0].contact_count; }
uint rounds_at_most() { return most_kick_rounds + 1u; }

// The notes as a thread knows them. A thread with one contact looks at them once a round, in goes_on(): on a GPU each look takes as long as
// a round's sums. What others note in the round that runs changes no answer below.
PRIVATE(Notes, known)

bool has_bounced(uint kick_round) { return known.bounce_round < kick_round; }

// Whether all contacts had settled by the last round. While a round runs of which this is true, nobody notes a contact that has not, so all
// threads find the same answer. In any other round the note only grows, which leaves the answer no.
bool have_settled(uint kick_round) {
  uint fewest = has_bounced(kick_round) ? known.bounce_round + fewest_rounds_from_bounce : fewest_kick_rounds;
  return kick_round + 1u >= fewest && known.unsettled_round + 2u <= kick_round;
}

// Whether impulses bounce in this round. It may have been noted meanwhile.
bool is_bounce(uint kick_round) {
  if (has_bounced(kick_round) || known.bounces_from >= kick_round) return false;
  if (kick_round + fewest_rounds_from_bounce > most_kick_rounds) return false;
  return known.bounce_round == kick_round || kick_round >= forced_bounce || have_settled(kick_round);
}

bool is_last(uint kick_round) {
  return !is_bounce(kick_round) && (have_settled(kick_round) || kick_round + 1u == most_kick_rounds);
}
bool is_kick(uint kick_round) { return kick_round > 0u && is_last(kick_round - 1u); }

// If no contact presses in the first two rounds, none does in the others. The notes also serve the thread in the next round.
bool goes_on(uint kick_round) {
  known = all_notes();
  return kick_round == 1u ? presses() : !is_kick(kick_round);
}

// Of a contact's vertices, or of their places.
bool meets_ground(uvec4 who) { return who.y == no_vertex; }

double inverse_mass_of(uint i) { return surface[uint(rest_position[i].w)].inverse_mass; }

// Returns row 3. Every vertex shares its mass among its contacts.
real4 resistance_of(uvec4 who, real4 weight, real settled) {
  double of_quantum = double(quantum());
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

uvec4 sums_of(uvec4 place, uint buffer_index) {
  return uvec4(sum_of_place(place.x, buffer_index), sum_of_place(place.y, buffer_index), sum_of_place(place.z, buffer_index),
               sum_of_place(place.w, buffer_index));
}

// What the impulses of the rounds so far changed the velocity of the contact's points against each other by [m/s].
real3 relative_change(uvec4 place, real4 weight, real4 resistance, uint buffer_index) {
  if (meets_ground(place)) return resistance.x * impulse_at(sum_of_place(place.x, buffer_index));
  real3 x, y, z, w;
  impulses_at(sums_of(place, buffer_index), x, y, z, w);
  x *= weight.x > real(0) ? resistance.x : resistance.y;
  y *= weight.y > real(0) ? resistance.x : resistance.y;
  z *= weight.z > real(0) ? resistance.x : resistance.y;
  w *= weight.w > real(0) ? resistance.x : resistance.y;
  return weight.y * (y - x) + weight.z * (z - x) + weight.w * (w - x);
}

// Adds an impulse to the vertices of a contact [quanta].
void push_vertices(uvec4 place, real4 weight, real3 impulse, uint buffer_index) {
  if (meets_ground(place))
    push_off(sum_of_place(place.x, buffer_index), impulse);
  else
    push_apart(sums_of(place, buffer_index), weight.y * impulse, weight.z * impulse, weight.w * impulse);
}

// In a group's own memory all of its threads do this.
void clear_sums(uvec4 place, uint buffer_index) {
  if (sums_are_near) return;
  clear_impulse(impulse_sum_of(buffer_index, vertex_count, place.x));
  if (meets_ground(place)) return;
  clear_impulse(impulse_sum_of(buffer_index, vertex_count, place.y));
  clear_impulse(impulse_sum_of(buffer_index, vertex_count, place.z));
  clear_impulse(impulse_sum_of(buffer_index, vertex_count, place.w));
}

// A contact in the rounds: its rows and its impulse, as physics/contact/contact.glsl says.
struct Held {
  uvec4 place;
  real4 normal_row;
  real4 weight;
  real4 goal_row;
  real4 resistance;
  real4 impulse;
  real4 ahead;
  real bounce;
  real least_impulse;
  real per_quantum;
};
PRIVATE(Held, held)

void fetch(uint c, uint kick_round) {
  uvec4 who = contact_vertex[c];
  held.place = uvec4(place_of(who.x), place_of(who.y), place_of(who.z), place_of(who.w));
  held.normal_row = contact_row[contact_rows * c];
  held.weight = contact_row[contact_rows * c + 1u];
  held.goal_row = contact_row[contact_rows * c + 2u];
  held.resistance = contact_row[contact_rows * c + 3u];
  held.impulse = impulse_row[c];
  real4 bounce_row = contact_row[contact_rows * c + 5u];
  held.bounce = bounce_row.x;
  held.least_impulse = bounce_row.y;
  held.per_quantum = real(1) / real(quantum());
  held.ahead = held.impulse;
  if (kick_round > 0u) {
    held.ahead = contact_row[contact_rows * c + 4u];
    return;
  }
  held.resistance = resistance_of(who, held.weight, held.resistance.w);
  contact_row[contact_rows * c + 3u] = held.resistance;
}

void store(uint c) {
  contact_row[contact_rows * c + 4u] = held.ahead;
  impulse_row[c] = held.impulse;
}

void store_least_impulse(uint c) { contact_row[contact_rows * c + 5u] = real4(held.bounce, held.least_impulse, 0, 0); }

void note_end(uint c, bool is_unsettled) {
  contact_row[contact_rows * c + 3u].w = is_unsettled ? real(-1) : real(0);
  TALLY_UP(control[0].count[unsettled_contacts], is_unsettled ? 1u : 0u)
}

// All contacts do this in one round. Those that bounce give more from here on, and momentum of the rounds starts anew. One that has not
// settled does not bounce: it may jam, and give far more than what stops it.
void bounce(uint c, uint kick_round, bool is_settled) {
  note_bounce(kick_round);
  if (held.bounce > real(1) && is_settled) held.impulse.x = held.least_impulse = held.bounce * held.impulse.x;
  held.ahead = held.impulse;
  store_least_impulse(c);
}

// For a contact that jams. Its coefficient of friction first drops to what it uses, then goes down step by step. What it gives at least may
// have come about in the jam, too, and nothing but its friction may hold that.
void loosen(uint c) {
  real sideways = length(real3(held.impulse.y, held.impulse.z, held.impulse.w));
  if (sideways < held.goal_row.w * held.impulse.x) held.goal_row.w = sideways / held.impulse.x;
  held.goal_row.w *= real(0.9);
  held.least_impulse *= real(0.9);
  contact_row[contact_rows * c + 2u] = held.goal_row;
  store_least_impulse(c);
}

void answer(uint c, uint kick_round, bool ends) {
  real4 had = held.ahead, before = held.impulse;
  real3 change = relative_change(held.place, held.weight, held.resistance, buffer_of(kick_round));
  held.impulse = next_impulse(had, held.normal_row, held.goal_row, change, held.resistance.z, held.least_impulse);
  held.ahead = held.impulse;
  real4 change_of_impulse = held.impulse - had;
  bool changes = dot(change_of_impulse, change_of_impulse) > held.resistance.w * held.resistance.w;
  if (ends) {
    note_end(c, changes && kick_round + 1u == most_kick_rounds);
    return;
  }
  if (is_bounce(kick_round)) {
    bounce(c, kick_round, !changes || kick_round < forced_bounce);
    return;
  }
  if (held.bounce > real(1) && held.impulse.x > real(0) && known.bounces_from > kick_round) note_bouncing(kick_round);
  bool turns = dot(had - held.impulse, held.impulse - before) > real(0);  // the sums went too far ahead
  uint first = has_bounced(kick_round) ? known.bounce_round : 0u;
  if (!turns) held.ahead += momentum_after(kick_round - first) * (held.impulse - before);
  if (!changes) return;
  note_unsettled(kick_round);
  if (kick_round >= max(jam_rounds, first + jam_rounds - forced_bounce)) loosen(c);
}

// Where a contact has a thread to itself, the thread keeps it from the first round to the last.
void push(uint c, uint kick_round) {
  bool starts = kick_round == 0u, ends = is_last(kick_round);
  if (starts || !has_own_thread) fetch(c, kick_round);
  if (!starts) answer(c, kick_round, ends);
  if (ends || !has_own_thread) store(c);
  if (ends) TALLY_UP(control[0].count[contact_pairs], held.impulse.x > real(0) ? 1u : 0u)
  clear_sums(held.place, buffer_of(kick_round + 2u));
  if (held.ahead == real4(0)) return;
  if (kick_round <= 1u) note_pressing();
  real3 along = held.ahead.x * real3(held.normal_row), across = real3(held.ahead.y, held.ahead.z, held.ahead.w);
  push_vertices(held.place, held.weight, held.per_quantum * (along + across), buffer_of(kick_round + 1u));
}

// The impulse on a vertex by all rounds [quanta].
dvec3 impulse_on(uint i, uint kick_round) { return exact_impulse_at(sum_of_place(place_of(i), buffer_of(kick_round))); }

void kick(uint i, uint kick_round) {
  if (i == no_vertex || atomicExchange(contact_weight[i], 0u) == 0u) return;  // another contact has kicked it
  dvec3 quanta = impulse_on(i, kick_round);
  uint b = uint(rest_position[i].w);
  if (quanta == dvec3(0) || surface[b].inverse_mass == double(0)) return;
  uint at = velocity_of(in_half(from_half, vertex_count, i));
  dvec3 velocity = LOAD3(motion, at) + (surface[b].inverse_mass * double(quantum())) * rotate_back(pose[b], quanta);
  STORE3(motion, at, velocity)
  rouse(b);
  ATOMIC_STORE(pressed[b], step_parts[0].parts + 1u);
  ADD_EXACTLY_TOGETHER(contact_sum[0], quanta.x)
  ADD_EXACTLY_TOGETHER(contact_sum[1], quanta.y)
  ADD_EXACTLY_TOGETHER(contact_sum[2], quanta.z)
}

// The mean of the vertex's velocities before and after the kick [m/s].
dvec3 mean_velocity_of(uint i, uint kick_round) {
  return LOAD3(start, start_velocity_of(i)) + (double(0.5) * inverse_mass_of(i) * double(quantum())) * impulse_on(i, kick_round);
}

// The same of the contact's points against each other.
dvec3 mean_velocity_at(uvec4 who, real4 weight, uint kick_round) {
  dvec3 first = mean_velocity_of(who.x, kick_round);
  if (meets_ground(who)) return first;
  return double(weight.y) * (mean_velocity_of(who.y, kick_round) - first) +
         double(weight.z) * (mean_velocity_of(who.z, kick_round) - first) +
         double(weight.w) * (mean_velocity_of(who.w, kick_round) - first);
}

double quanta_of_energy(double energy) { return nearest_whole(energy / quantum_of_energy()); }

// A sum that few contacts add to.
void add_energy(uint k, double energy) {
  double whole = quanta_of_energy(energy);
  if (whole != double(0)) ADD_EXACTLY(contact_sum[k], whole)
}

bool ended_unsettled(uint c) { return contact_row[contact_rows * c + 3u].w < real(0); }

bool first_moves(uvec4 who) { return inverse_mass_of(who.x) != double(0); }
bool second_moves(uvec4 who) { return !meets_ground(who) && inverse_mass_of(who.w) != double(0); }

void note_static_pressure(uvec4 who) {
  if (first_moves(who) == second_moves(who)) return;
  uint b = uint(rest_position[first_moves(who) ? who.x : who.w].w);
  ATOMIC_STORE(status[b].pressed_by_static, step_parts[0].parts + 1u);
}

// Half of what a contact gave stands for either body, or all of it for one that meets what does not move.
void share_energy(uvec4 who, double energy) {
  double share_of_it = first_moves(who) && second_moves(who) ? double(0.5) * energy : energy;
  if (first_moves(who)) add_energy(unsettled_energy_of(uint(rest_position[who.x].w)), share_of_it);
  if (second_moves(who)) add_energy(unsettled_energy_of(uint(rest_position[who.w].w)), share_of_it);
}

// What a scripted body's contact gives by moving [J]: the impulse along the velocity of its point.
double work_of_script(uvec4 who, real4 weight, dvec3 impulse) {
  if (meets_ground(who) || first_moves(who) == second_moves(who)) return double(0);
  dvec3 velocity = dvec3(0);
  for (int k = 0; k < 4; ++k)
    if (inverse_mass_of(who[k]) == double(0)) velocity -= double(weight[k]) * LOAD3(start, start_velocity_of(who[k]));
  return dot(impulse, velocity);
}

// An impulse gives as much energy as it would along the mean of the velocities before and after.
void add_work(uint c, uint kick_round) {
  real4 impulse = impulse_row[c], normal_row = contact_row[contact_rows * c];
  if (!(impulse.x > real(0))) return;
  note_static_pressure(contact_vertex[c]);
  dvec3 mean = mean_velocity_at(contact_vertex[c], contact_row[contact_rows * c + 1u], kick_round);
  dvec3 normal_part = double(impulse.x) * dvec3(double(normal_row.x), double(normal_row.y), double(normal_row.z));
  dvec3 side_part = dvec3(double(impulse.y), double(impulse.z), double(impulse.w));
  double along = dot(normal_part, mean), across = dot(side_part, mean);
  double by_script = work_of_script(contact_vertex[c], contact_row[contact_rows * c + 1u], normal_part + side_part);
  ADD_EXACTLY_TOGETHER(contact_sum[energy_given], quanta_of_energy(max(along + across, double(0))))
  ADD_EXACTLY_TOGETHER(contact_sum[energy_taken], quanta_of_energy(max(-along - across, double(0))))
  ADD_EXACTLY_TOGETHER(contact_sum[friction_work], quanta_of_energy(-across))
  add_energy(work_of_scripts, by_script);
  if (ended_unsettled(c)) share_energy(contact_vertex[c], along + across);
}

void solve_contacts(uint c, uint kick_round) {
  if (kick_round == 0u || !has_own_thread) known = all_notes();
  if (!is_kick(kick_round)) {
    push(c, kick_round);
    return;
  }
  add_work(c, kick_round);
  for (int k = 0; k < 4; ++k) kick(contact_vertex[c][k], kick_round);
}
