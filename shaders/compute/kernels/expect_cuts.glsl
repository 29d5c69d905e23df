// One thread serves one vertex after the integrator. It finds the way that the vertex went, its box, and the part of it that stays in the
// cage. If a step was undone, it takes the kick back. It finds what bodies owe for contacts that ended unsettled.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/exact_sum.glsl"
#include "../physics/contact/surface.glsl"
READ(control)
READ(pose)
READ(status)
READ(surface)
READ(rest_position)
WRITE(motion)
READ(start)
READ(unkicked_velocity)
WRITE(cage)
READ(cluster)
READ(ground)
WRITE(contact_list)
WRITE(contact_sum)
WRITE(contact_total)
WRITE(way)
WRITE(cut)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, from_half)
PARAMETER(uint, may_undo_steps)  // 1: a tolerance may
PARAMETER(uint, ground_count)
PARAMETER(double, least_speed)
PARAMETER(double, largest_body)  // radius at rest [m]
#include "parts/flight.glsl"
#include "parts/quantum.glsl"
#include "parts/is_left_alone.glsl"
#include "parts/store_vertex_box.glsl"
#include "parts/load_vertex_box.glsl"

bool was_made() { return control[0].time_step > double(0); }

// The part of a way along one axis that ends before the wall.
double part_to(double from, double along, double lower, double upper) {
  double room = along > double(0) ? upper - from : from - lower;
  return abs(along) > room ? double(0.99) * max(room, double(0)) / abs(along) : double(1);
}

// The part of a way that does not end below a ground. A vertex may come down to a fiftieth of the gap, but not go down from there.
double part_above(uint g, dvec3 from, dvec3 gone, double gap) {
  dvec3 normal = LOAD3(ground[g].normal, 0u);
  double height = dot(normal, from) - ground[g].offset, sinks = -dot(normal, gone);
  double room = max(height - double(0.02) * gap, double(0));
  return sinks > room ? double(0.99) * room / sinks : double(1);
}

// What contacts have done in this step.
void add_contact_sums() {
  for (uint k = 0u; k < contact_sums; ++k) {
    if (was_made()) contact_total[k] += (k < 3u ? double(quantum()) : quantum_of_energy()) * whole_of(contact_sum[k]);
    contact_sum[k] = uvec2(0u);
  }
}

// What contacts that ended unsettled have given the body beyond what they took. It has to pay for that.
void find_energy_due(uint b) {
  double energy = was_made() ? max(quantum_of_energy() * whole_of(contact_sum[unsettled_energy_of(b)]), double(0)) : double(0);
  contact_total[unsettled_energy_of(b)] = energy;
  contact_sum[unsettled_energy_of(b)] = uvec2(0u);
  if (energy > double(0)) ATOMIC_STORE(contact_list[0].has_dues, 1u);
}

// Rounded outward, by more than places err. Those about a body's centre err by some roundings in fp64.
void bound_way(uint i, uint b, dvec3 from, dvec3 together, dvec3 own) {
  dvec3 by_flight = from + together, to = by_flight + own;
  dvec3 lower = min(min(from, by_flight), to), upper = max(max(from, by_flight), to);
  dvec3 farthest = max(abs(lower), abs(upper));
  double far = rounded_from(double(2) * sum_of_sizes(farthest), sum_of_sizes(LOAD3(pose[b].origin, 0u)), largest_body);
  dvec3 slack = farthest * double(1.2e-7) + dvec3(double(32) * double(1.1e-16) * far);
  store_vertex_box(way_box_of(i), vec3(lower - slack), vec3(upper + slack));
}

void take_kick_back(uint i) {
  STORE3(motion, velocity_of(in_half(other_half(from_half), vertex_count, i)), LOAD3(unkicked_velocity, force_of(i)))
}

void expect_cuts(uint i) {
  if (i == 0u) add_contact_sums();
  uint b = uint(rest_position[i].w);
  if (i == 0u || uint(rest_position[i - 1u].w) != b) {
    find_energy_due(b);
    cut[flight_stop_of(vertex_count, b)] = cut[flight_stop_of(vertex_count, body_count + b)] = at_no_cut;
  }
  if (is_left_alone(b)) return;
  uint before = displacement_of(in_half(from_half, vertex_count, i));
  uint after = displacement_of(in_half(other_half(from_half), vertex_count, i));
  bool is_movable = surface[b].inverse_mass != double(0);
  dvec3 gone = dvec3(0);
  if (may_undo_steps != 0u && !was_made()) take_kick_back(i);
  if (is_movable) gone = rotate(pose[b], LOAD3(motion, after) - LOAD3(motion, before));
  dvec3 from = LOAD3(start, start_position_of(i)), together = flight_in_step(b, from), own = is_movable ? gone - together : dvec3(0);
  STORE3(way, force_of(i), own)
  double part = double(1);
  PaddedBox room = load_vertex_box(cage_of(i));
  for (int k = 0; k < 3; ++k) part = min(part, part_to(from[k] + together[k], own[k], double(room.lower[k]), double(room.upper[k])));
  for (uint g = 0u; g < ground_count; ++g)
    if (is_movable) part = min(part, part_above(g, from + together, own, gap_above(ground[g], surface[b])));
  bound_way(i, b, from, together, part * own);
  cut[i] = is_movable ? floatBitsToUint(float(part) * (part < double(1) ? 0.999999f : 1.0f)) : 0u;
  for (uint row = 1u; row <= plane_rounds; ++row) cut[cut_in(row, vertex_count, i)] = floatBitsToUint(1.0f);
  cut[stop_of(vertex_count, i)] = at_no_cut;
}
