// A kernel in rounds. One thread serves some vertices of a body that had motions cut short or contacts that gave energy, or still owes. A
// vertex that is held back leaves its springs with energy, which the body pays with the kinetic energy of its deformation. This keeps its
// momentum and its angular momentum. If that is not enough, bodies that hook into each other pay with their rigid motions against each
// other. If one of them, or a body alone, was cut short in the world, because it is beside what does not move, the rest is paid with
// their rigid motion as one.
// What bodies can't pay, they owe. What cuts take from a body's angular momentum comes back as spin.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/debt.glsl"
#include "../physics/contact/part_sums.glsl"
#include "../physics/contact/surface.glsl"
READ(control)
READ(body)
READ(pose)
WRITE(status)
READ(rest_position)
WRITE(motion)
READ(cut)
READ(way)
READ(near_pair)
READ(vertex_part)
READ(vertex_part_range)
SHARED_WRITE(contact_list)
SHARED_WRITE(part_sum)
SHARED_WRITE(cluster)
SHARED_WRITE(debt)
WRITE(contact_total)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, from_half)
PARAMETER(uint, part_count)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(uint, contact_capacity)

const uint last_round = 12u;

#include "parts/dues.glsl"
// A step that is empty or was undone leaves clusters as they are.
uint items_in_a_round() { return has_dues() && control[0].time_step > double(0) ? part_count : 0u; }
uint rounds_at_most() { return last_round + 1u; }
bool goes_on(uint number) { return number < last_round; }

uint moments_half() { return other_half(from_half); }
#include "parts/flight.glsl"
#include "parts/is_in_cluster.glsl"
#include "parts/full_lists.glsl"
#include "parts/stays.glsl"
#include "parts/rigid_motion_by_parts.glsl"
#include "parts/rouse.glsl"
#include "parts/is_left_alone.glsl"

dvec3 flight_of_vertex(uint i, uint b) {
  dvec3 displacement = LOAD3(motion, displacement_of(in_half(from_half, vertex_count, i)));
  return flight_in_step(b, to_world(pose[b], dvec3(vec3(rest_position[i])) + displacement));
}

// What a vertex lacks of its flight because its whole body keeps its place [m]. It strains no spring.
dvec3 missing_together(uint i, uint b) { return has_flight(b) && stays(b) ? flight_of_vertex(i, b) : dvec3(0); }

// What it lacks of its own way, which is all of its way if its flight was stopped [m].
dvec3 missing_alone(uint i, uint b) {
  dvec3 own = LOAD3(way, force_of(i));
  if (flight_was_stopped(b) && !stays(b)) own += flight_of_vertex(i, b);
  return (double(1) - double(uintBitsToFloat(cut[i]))) * own;
}

// The energy that springs and gravity have more because the vertex went only this part of its way [J]. They would have given it the
// change of its velocity over the step. No displacement of one vertex by d takes more than N k d^2 / 2 beyond that.
double energy_of_cut(uint i, uint b) {
  dvec3 change = velocity_of_vertex(i) - LOAD3(motion, velocity_of(in_half(from_half, vertex_count, i)));
  dvec3 missing = missing_alone(i, b);
  double stiffness = double(body[b].vertex_count) * body[b].unit_force * body[b].inverse_unit;
  double given = dot(rotate(pose[b], change), missing + missing_together(i, b)) / (body[b].inverse_mass * control[0].time_step);
  return given + double(0.5) * stiffness * dot(missing, missing);
}

dvec3 momentum_of(uint b) {
  Moments m = moments_of_body(b);
  return rotate(pose[b], LOAD3(m.velocity, 0u)) / body[b].inverse_mass;
}

double mass_of(uint b) { return double(body[b].vertex_count) / body[b].inverse_mass; }

bool is_cut_short(uint i) { return uintBitsToFloat(cut[i]) < 1.0f; }

void note_cuts(uvec4 part, uint item) {
  uint cuts = 0u;
  for (uint i = part.y; i < part.z && !is_left_alone(part.x); ++i) {
    if (cut[stop_of(vertex_count, i)] != at_no_cut) cuts |= at_a_cut_bit;
    if (!is_cut_short(i)) continue;
    cuts |= cut_short_bit | at_a_cut_bit;
    if (!has_flight(part.x)) cuts |= held_bit;
  }
  part_sum[item].cuts = cuts;
}

void add_up_cuts(uvec4 part, uint item, bool are_blocks) {
  PartsToAdd parts = parts_to_add(part, item, are_blocks);
  for (uint k = parts.from; k < parts.end; k += parts.step) part_sum[item].cuts |= part_sum[k].cuts;
}

// What happened to the body's motions in this step, if it moves.
uint cuts_of(uint b) { return has_sums(b) ? part_sum[sums_of_body(b)].cuts : 0u; }
bool was_cut_short(uint b) { return (cuts_of(b) & cut_short_bit) != 0u; }
bool was_at_a_cut(uint b) { return (cuts_of(b) & at_a_cut_bit) != 0u; }
bool was_held(uint b) { return (cuts_of(b) & held_bit) != 0u; }

// Whether there was room for all pairs of bodies. If not, which ones are in the list depends on threads.
bool knows_all_pairs() { return control[0].count[body_pairs_lost] == 0u; }

// Of the bodies near it that can move the first one from a number on, or no_vertex. The list of pairs is in no fixed order, and sums
// need one.
uint next_partner(uint b, uint from) {
  uint found = no_vertex;
  for (uint k = knows_all_pairs() ? status[b].first_pair : 0u; k != 0u;) {
    uvec4 pair = near_pair[k - 1u];
    uint other = pair.x == b ? pair.y : pair.x;
    if (other >= from && status[other].activity == moving) found = min(found, other);
    k = pair.x == b ? pair.z : pair.w;
  }
  return found;
}

// The velocity that the body and those near it that were at a cut, too, have together, in its frame [m/s].
dvec3 velocity_of_all_at_cuts(uint b) {
  dvec3 momentum = momentum_of(b);
  double mass = mass_of(b);
  for (uint other = next_partner(b, 0u); other != no_vertex; other = next_partner(b, other + 1u)) {
    if (!was_at_a_cut(other)) continue;
    momentum += momentum_of(other);
    mass += mass_of(other);
  }
  return rotate_back(pose[b], momentum / mass);
}

// Cuts move a vertex and leave its velocity, so its angular momentum changes. What flies along together and stays behind does not turn, so
// the flight does not count.
void sum_lost_turning(uvec4 part, uint item) {
  dvec3 lost = dvec3(0);
  if ((part_sum[item].cuts & cut_short_bit) != 0u) {
    dvec3 together = velocity_of_all_at_cuts(part.x);
    for (uint i = part.y; i < part.z; ++i) {
      if (!is_cut_short(i)) continue;
      dvec3 missing = missing_alone(i, part.x) + missing_together(i, part.x);
      lost += cross(rotate_back(pose[part.x], missing), velocity_of_vertex(i) - together);
    }
  }
  STORE3(part_sum[item].lost_turning, 0u, lost)
}

void add_up_lost_turning(uvec4 part, uint item, bool are_blocks) {
  PartsToAdd parts = parts_to_add(part, item, are_blocks);
  if (parts.from >= parts.end) return;
  dvec3 lost = LOAD3(part_sum[item].lost_turning, 0u);
  for (uint k = parts.from; k < parts.end; k += parts.step) lost += LOAD3(part_sum[k].lost_turning, 0u);
  STORE3(part_sum[item].lost_turning, 0u, lost)
}

// The body's moments if cuts had left its angular momentum as it was.
Moments restored_moments_of(uint b) {
  Moments m = moments_of_body(b);
  dvec3 turning = LOAD3(m.turning, 0u);
  if (has_sums(b)) turning += LOAD3(part_sum[sums_of_body(b)].lost_turning, 0u);
  STORE3(m.turning, 0u, turning)
  return m;
}

RigidMotion restored_motion_of(uint b) {
  return rigid_motion_with(restored_moments_of(b), double(body[b].vertex_count), place_of(body[b].first_vertex), dvec3(0));
}

void sum_energies_of(uvec4 part, uint item) {
  uint b = part.x;
  RigidMotion rigid = rigid_motion_of_body(b), restored = restored_motion_of(b);
  double deformation = double(0), all_rigid = double(0), missed = double(0), gained = double(0);
  bool was_cut = was_cut_short(b);
  for (uint i = part.y; i < part.z; ++i) {
    dvec3 place = place_of(i), along = velocity_at(rigid, place), beside = velocity_of_vertex(i) - along;
    dvec3 along_restored = velocity_at(restored, place);
    deformation += dot(beside, beside);
    all_rigid += dot(along_restored, along_restored);
    if (was_cut) gained += double(0.5) * (dot(along_restored, along_restored) - dot(along, along)) / body[b].inverse_mass;
    if (!was_cut || !is_cut_short(i)) continue;
    gained += energy_of_cut(i, b);
    missed += dot(rotate(pose[b], along_restored), missing_alone(i, b) + missing_together(i, b)) / control[0].time_step;
  }
  part_sum[item].deformation = double(0.5) * deformation / body[b].inverse_mass;
  part_sum[item].rigid = double(0.5) * all_rigid / body[b].inverse_mass;
  part_sum[item].missed = double(0.5) * missed / body[b].inverse_mass;
  part_sum[item].gained = gained;
}

void add_up_energies(uvec4 part, uint item, bool are_blocks) {
  PartsToAdd parts = parts_to_add(part, item, are_blocks);
  for (uint k = parts.from; k < parts.end; k += parts.step) {
    part_sum[item].deformation += part_sum[k].deformation;
    part_sum[item].rigid += part_sum[k].rigid;
    part_sum[item].missed += part_sum[k].missed;
    part_sum[item].gained += part_sum[k].gained;
  }
}

// Without what others may pay. What unsettled contacts gave is due, too.
Means own_means_of(uint b) {
  Means m;
  m.deformation = m.rigid = m.missed = m.due = double(0);
  if (has_sums(b)) {
    uint sums = sums_of_body(b);
    m.deformation = part_sum[sums].deformation;
    m.rigid = part_sum[sums].rigid;
    m.missed = part_sum[sums].missed;
    m.due = part_sum[sums].gained;
  }
  m.due = max(debt[b].energy + m.due, double(0)) + contact_total[unsettled_energy_of(b)];
  return m;
}

// A body that nothing holds keeps its rigid motion, though it owes: its vertices may have left their cages in free flight.
Means means_of(uint b) {
  Means m = own_means_of(b);
  if (!was_held(b) || is_in_cluster(b)) m.rigid = m.missed = double(0);
  return m;
}

// Whether motions of the body were cut short in this step, or before and it still owes for them.
bool was_caught(uint b) { return was_cut_short(b) || (debt[b].is_for_cuts != 0u && debt[b].energy > double(0)); }
bool owes_for_cuts(uint b) { return was_caught(b) && own_means_of(b).due > double(0); }
uint find_involvement(uint b) {
  if (status[b].activity != moving) return not_involved;
  if (owes_for_cuts(b)) return owing;
  return was_at_a_cut(b) ? involved : not_involved;
}
void note_involvement(uint b, uint item) {
  if (item == sums_of_body(b)) part_sum[item].involvement = find_involvement(b);
}
uint involvement_of(uint b) { return has_sums(b) ? part_sum[sums_of_body(b)].involvement : not_involved; }

void begin_cluster(uint b) {
  cluster[b].sum = no_moments();
  cluster[b].mass = double(0);
  cluster[b].means.deformation = cluster[b].means.rigid = cluster[b].means.missed = cluster[b].means.due = double(0);
  cluster[b].first = b;
  cluster[b].bodies = cluster[b].is_held = cluster[b].moves_as_one = 0u;
}

bool belong_together(uint a, uint b) {
  uint first = involvement_of(a), second = involvement_of(b);
  return min(first, second) != not_involved && max(first, second) == owing;
}

// A body that owes belongs together with those near it that owe, too, or that were at a cut.
void join_bodies() {
  bool changed = knows_all_pairs();
  while (changed) {
    changed = false;
    for (uint k = 0u; k < control[0].near_pair_count; ++k) {
      uvec4 pair = near_pair[k];
      uint first = min(cluster[pair.x].first, cluster[pair.y].first);
      if (cluster[pair.x].first == cluster[pair.y].first || !belong_together(pair.x, pair.y)) continue;
      cluster[pair.x].first = cluster[pair.y].first = first;
      changed = true;
    }
  }
}

dvec3 first_place_of(uint b) { return to_world(pose[b], place_of(body[b].first_vertex)); }

// Adds a body's moments about its centre, turned into the world, and those of the centre itself.
void add_to_cluster(uint b) {
  uint first = cluster[b].first;
  double count = double(body[b].vertex_count), mass = double(1) / body[b].inverse_mass;
  Moments m = restored_moments_of(b), sum = cluster[first].sum;
  dvec3 place = LOAD3(m.place, 0u), from_first = place / count, frame_velocity = LOAD3(m.velocity, 0u) / count;
  dvec3 frame_turning = LOAD3(m.turning, 0u) - cross(place, frame_velocity);
  dvec3 squares = LOAD3(m.spread, 0u) - place * from_first;
  dvec3 products = LOAD3(m.spread, 3u) - dvec3(place.x * from_first.y, place.y * from_first.z, place.z * from_first.x);
  dvec3 x = rotate(pose[b], dvec3(squares.x, products.x, products.z)), y = rotate(pose[b], dvec3(products.x, squares.y, products.y)),
        z = rotate(pose[b], dvec3(products.z, products.y, squares.z));
  dvec3 row_x = rotate(pose[b], dvec3(x.x, y.x, z.x)), row_y = rotate(pose[b], dvec3(x.y, y.y, z.y)),
        row_z = rotate(pose[b], dvec3(x.z, y.z, z.z));
  dvec3 centre = to_world(pose[b], place_of(body[b].first_vertex) + from_first) - first_place_of(first);
  dvec3 velocity = rotate(pose[b], frame_velocity);
  dvec3 all_place = LOAD3(sum.place, 0u) + mass * count * centre, all_velocity = LOAD3(sum.velocity, 0u) + mass * count * velocity;
  dvec3 all_turning = LOAD3(sum.turning, 0u) + mass * (rotate(pose[b], frame_turning) + count * cross(centre, velocity));
  dvec3 all_squares = LOAD3(sum.spread, 0u) + mass * (dvec3(row_x.x, row_y.y, row_z.z) + count * centre * centre);
  dvec3 all_products = LOAD3(sum.spread, 3u) + mass * (dvec3(row_x.y, row_y.z, row_z.x) +
                                                       count * dvec3(centre.x * centre.y, centre.y * centre.z, centre.z * centre.x));
  STORE3(sum.place, 0u, all_place)
  STORE3(sum.velocity, 0u, all_velocity)
  STORE3(sum.turning, 0u, all_turning)
  STORE3(sum.spread, 0u, all_squares)
  STORE3(sum.spread, 3u, all_products)
  cluster[first].sum = sum;
  cluster[first].mass += mass * count;
  cluster[first].bodies += 1u;
  Means means = own_means_of(b);
  cluster[first].means.deformation += means.rigid;
  cluster[first].means.missed += means.missed;
  cluster[first].means.due += max(means.due - means.deformation, double(0));
  if (was_held(b)) cluster[first].is_held = 1u;
}

// Finds the cluster's rigid motion, and what its bodies' motions have beyond it. A body alone is no cluster.
void end_cluster(uint first) {
  if (cluster[first].bodies < 2u) {
    cluster[first].bodies = 0u;
    return;
  }
  cluster[body_count].bodies += cluster[first].bodies;
  cluster[first].moves_as_one = cluster[body_count].moves_as_one = 1u;
  Moments sum = cluster[first].sum;
  double mass = cluster[first].mass;
  RigidMotion of_cluster = rigid_motion_with(sum, mass, first_place_of(first), dvec3(0));
  dvec3 velocity = LOAD3(of_cluster.velocity, 0u), turning = LOAD3(sum.turning, 0u) - cross(LOAD3(sum.place, 0u), velocity);
  double of_all = double(0.5) * (mass * dot(velocity, velocity) + dot(turning, LOAD3(of_cluster.spin, 0u)));
  cluster[first].motion = of_cluster;
  Means means = cluster[first].means;
  if (cluster[first].is_held != 0u) cluster[first].means.rigid = of_all;
  cluster[first].means.missed = means.deformation > double(0) ? of_all * (means.missed / means.deformation) : double(0);
  cluster[first].means.deformation = max(means.deformation - of_all, double(0));
}

void find_clusters() {
  for (uint b = 0u; b <= body_count; ++b) begin_cluster(b);
  join_bodies();
  for (uint b = 0u; b < body_count; ++b)
    if (involvement_of(b) != not_involved) add_to_cluster(b);
  for (uint b = 0u; b < body_count; ++b) end_cluster(b);
}

// A copy, because NVIDIA's driver passes no struct of an array that is SHARED_WRITE to a function.
Means means_of_cluster(uint b) { return cluster[cluster[b].first].means; }

// What a body keeps of its rigid motion beyond that of its cluster, which is none if the body is alone.
double kept_of_rigid(uint b, IN(Means) means) {
  return is_in_cluster(b) ? kept_of_deformation(means_of_cluster(b)) : kept_of_rigid_motion(means);
}

// What all of a cluster keep of its own motion.
double kept_together(uint b) { return is_in_cluster(b) ? kept_of_rigid_motion(means_of_cluster(b)) : double(1); }

// The velocity that all bodies of a cluster have in common, in the body's frame [m/s].
dvec3 common_velocity(uint b, IN(RigidMotion) of_cluster, dvec3 place) {
  return rotate_back(pose[b], velocity_at(of_cluster, to_world(pose[b], place)));
}

void pay(uvec4 part) {
  uint b = part.x;
  Means means = means_of(b);
  double of_deformation = kept_of_deformation(means), of_rigid = kept_of_rigid(b, means), of_all = kept_together(b);
  if (of_deformation == double(1) && of_rigid == double(1) && of_all == double(1) && !was_cut_short(b)) return;
  rouse(b);
  bool shares = is_in_cluster(b);
  RigidMotion rigid = rigid_motion_of_body(b), restored = restored_motion_of(b), of_cluster = cluster[cluster[b].first].motion;
  for (uint i = part.y; i < part.z; ++i) {
    dvec3 place = place_of(i), along = velocity_at(restored, place), beside = velocity_of_vertex(i) - velocity_at(rigid, place);
    dvec3 together = shares ? common_velocity(b, of_cluster, place) : dvec3(0);
    dvec3 velocity = of_all * together + of_rigid * (along - together) + of_deformation * beside;
    STORE3(motion, velocity_of(vertex_at(i)), velocity)
  }
}

void note_debt(uint b) {
  Means means = means_of(b);
  debt[b].is_for_cuts = was_caught(b) ? 1u : 0u;
  debt[b].energy = owed_after(means);
  dvec3 lost = dvec3(0);
  if (is_in_cluster(b)) {
    uint first = cluster[b].first;
    Means of_all = cluster[first].means;
    if (of_all.due > double(0)) debt[b].energy *= owed_after(of_all) / of_all.due;
    if (b == first) lost = ((double(1) - kept_of_rigid_motion(of_all)) * cluster[b].mass) * LOAD3(cluster[b].motion.velocity, 0u);
  } else {
    double mass = (double(1) - kept_of_rigid_motion(means)) * mass_of(b);
    lost = mass * rotate(pose[b], LOAD3(rigid_motion_of_body(b).velocity, 0u));
  }
  STORE3(debt[b].lost, 0u, lost)
}

// The motion with which a cluster goes on after it has paid.
void slow_down_cluster(uint first) {
  double kept = kept_of_rigid_motion(means_of_cluster(first));
  dvec3 velocity = kept * LOAD3(cluster[first].motion.velocity, 0u), spin = kept * LOAD3(cluster[first].motion.spin, 0u);
  STORE3(cluster[first].motion.velocity, 0u, velocity)
  STORE3(cluster[first].motion.spin, 0u, spin)
}

// What does not move has got the momentum that bodies lost.
void note_debts() {
  debt[body_count].energy = double(0);
  for (uint b = 0u; b < body_count; ++b) {
    debt[body_count].energy += debt[b].energy;
    if (cluster[b].bodies != 0u) slow_down_cluster(b);
    for (uint k = 0u; k < 3u; ++k) {
      contact_total[k] -= debt[b].lost[k];
      debt[b].lost[k] = double(0);
    }
  }
}

void sum_up(uvec4 part, uint item, uint number) {
  if (number == 0u) sum_moments_of(part, item);
  if (number == 0u) note_cuts(part, item);
  if (number == 1u || number == 2u) add_up_moments(part, item, number == 2u);
  if (number == 1u || number == 2u) add_up_cuts(part, item, number == 2u);
  if (number == 3u) sum_lost_turning(part, item);
  if (number == 4u || number == 5u) add_up_lost_turning(part, item, number == 5u);
  if (number == 6u) sum_energies_of(part, item);
  if (number == 7u || number == 8u) add_up_energies(part, item, number == 8u);
}

void pay_dues(uint item, uint number) {
  uvec4 part = vertex_part[item];
  bool moves = status[part.x].activity == moving;
  if (moves) sum_up(part, item, number);
  if (number == 8u) note_involvement(part.x, item);
  if (number == 9u && item == 0u) find_clusters();
  if (number == 10u && moves) pay(part);
  if (number == 11u && moves && item == sums_of_body(part.x)) note_debt(part.x);
  if (number == last_round && item == 0u) note_debts();
}
