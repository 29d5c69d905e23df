// A kernel in rounds. One thread serves some vertices of a body that had motions cut short, or still owes for earlier cuts. A vertex that
// is held back leaves its springs with energy, which the body pays with the kinetic energy of its deformation. This keeps its momentum and
// its angular momentum. What it can't pay, it owes. If it is near no other body that moves, what is held it is held by what does not move.
// Then its rigid motion pays, too.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/rigid_motion.glsl"
#include "../physics/contact/debt.glsl"
#include "../physics/contact/surface.glsl"
READ(control)
READ(body)
READ(pose)
READ(status)
READ(rest_position)
WRITE(motion)
READ(cut)
READ(way)
READ(near_pair)
READ(vertex_part)
READ(vertex_part_range)
SHARED_WRITE(contact_list)
SHARED_WRITE(part_moment)
SHARED_WRITE(part_energy)
SHARED_WRITE(debt)
WRITE(contact_total)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, from_half)
PARAMETER(uint, part_count)

const uint last_round = 4u;

// The last debt is that of all bodies together.
bool is_needed() { return contact_list[0].has_cuts != 0u || debt[body_count].energy > double(0); }
uint items_in_a_round() { return is_needed() ? part_count : 0u; }
uint rounds_at_most() { return last_round + 1u; }
bool goes_on(uint number) { return number < last_round && is_needed(); }

uint moments_half() { return other_half(from_half); }
#include "parts/rigid_motion_by_parts.glsl"

// The energy that springs and gravity have more because the vertex went only this part of its way [J]. They would have given it the
// change of its velocity over the step. No displacement of one vertex by d takes more than N k d^2 / 2 beyond that.
double energy_of_cut(uint i, uint b, double part) {
  dvec3 change = velocity_of_vertex(i) - LOAD3(motion, velocity_of(in_half(from_half, vertex_count, i)));
  dvec3 held = (double(1) - part) * LOAD3(way, force_of(i));
  double stiffness = double(body[b].vertex_count) * body[b].unit_force * body[b].inverse_unit;
  return dot(rotate(pose[b], change), held) / (body[b].inverse_mass * control[0].time_step) + double(0.5) * stiffness * dot(held, held);
}

void sum_energies_of(uvec4 part, uint item) {
  uint b = part.x;
  RigidMotion rigid = rigid_motion_of_body(b);
  double deformation = double(0), all_rigid = double(0), gained = double(0);
  for (uint i = part.y; i < part.z; ++i) {
    dvec3 along = velocity_at(rigid, place_of(i)), beside = velocity_of_vertex(i) - along;
    deformation += dot(beside, beside);
    all_rigid += dot(along, along);
    double part_of_way = double(uintBitsToFloat(cut[i]));
    if (part_of_way < double(1)) gained += energy_of_cut(i, b, part_of_way);
  }
  part_energy[3u * item] = double(0.5) * deformation / body[b].inverse_mass;
  part_energy[3u * item + 1u] = double(0.5) * all_rigid / body[b].inverse_mass;
  part_energy[3u * item + 2u] = gained;
}

bool is_near_one_that_moves(uint b) {
  bool is_near = false;
  for (uint k = 0u; k < control[0].near_pair_count; ++k) {
    uvec2 pair = near_pair[k];
    uint other = pair.x == b ? pair.y : pair.x;
    if (pair.x == b || pair.y == b) is_near = is_near || status[other].activity != immovable;
  }
  return is_near;
}

Means means_of(uint b) {
  uvec2 range = vertex_part_range[b];
  dvec3 sum = dvec3(0);
  for (uint k = range.x; k < range.x + range.y; ++k) sum += LOAD3(part_energy, 3u * k);
  Means m;
  m.deformation = sum.x;
  m.due = max(debt[b].energy + sum.z, double(0));
  m.rigid = m.due > m.deformation && !is_near_one_that_moves(b) ? sum.y : double(0);
  return m;
}

void pay(uvec4 part) {
  uint b = part.x;
  Means means = means_of(b);
  if (means.due == double(0)) return;
  double of_deformation = kept_of_deformation(means), of_rigid = kept_of_rigid_motion(means);
  RigidMotion rigid = rigid_motion_of_body(b);
  for (uint i = part.y; i < part.z; ++i) {
    dvec3 along = velocity_at(rigid, place_of(i)), beside = velocity_of_vertex(i) - along;
    dvec3 velocity = of_rigid * along + of_deformation * beside;
    STORE3(motion, velocity_of(vertex_at(i)), velocity)
  }
}

void note_debt(uint b) {
  Means means = means_of(b);
  double lost = (double(1) - kept_of_rigid_motion(means)) * double(body[b].vertex_count) / body[b].inverse_mass;
  dvec3 momentum = lost * rotate(pose[b], LOAD3(rigid_motion_of_body(b).velocity, 0u));
  debt[b].energy = owed_after(means);
  STORE3(debt[b].lost, 0u, momentum)
}

// What does not move has got the momentum that bodies lost.
void note_debts() {
  debt[body_count].energy = double(0);
  for (uint b = 0u; b < body_count; ++b) {
    debt[body_count].energy += debt[b].energy;
    for (uint k = 0u; k < 3u; ++k) {
      contact_total[k] -= debt[b].lost[k];
      debt[b].lost[k] = double(0);
    }
  }
}

void pay_for_cuts(uint item, uint number) {
  if (number == last_round && item == 0u) note_debts();
  uvec4 part = vertex_part[item];
  if (status[part.x].activity != moving) return;
  if (number == 0u) sum_moments_of(part, item);
  if (number == 1u) sum_energies_of(part, item);
  if (number == 2u) pay(part);
  if (number == 3u && item == vertex_part_range[part.x].x) note_debt(part.x);
}
