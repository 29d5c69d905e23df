// One thread serves one vertex after the integrator. It finds the way that the vertex went, and the part of it that stays in its cage.
// If a step was undone, it takes the kick back.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/exact_sum.glsl"
#include "../physics/contact/surface.glsl"
READ(control)
READ(pose)
READ(surface)
READ(rest_position)
WRITE(motion)
READ(start)
READ(unkicked)
READ(cage)
READ(ground)
WRITE(contact_list)
WRITE(outside_sum)
WRITE(outside_impulse)
WRITE(way)
WRITE(cut)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(uint, ground_count)
PARAMETER(double, least_speed)
PARAMETER(double, heaviest_vertex)
#include "parts/quantum.glsl"

bool was_made() { return control[0].time_step > double(0); }

// The part of a way along one axis that ends before the wall.
double part_to(double from, double along, double lower, double upper) {
  double room = along > double(0) ? upper - from : from - lower;
  return abs(along) > room ? double(0.99) * max(room, double(0)) / abs(along) : double(1);
}

// The part of a way that does not end below a ground. A vertex may come down to a fiftieth of the gap, but not go down from there.
double part_above(uint g, dvec3 from, dvec3 gone, double gap) {
  double height = dot(LOAD3(ground[g].normal, 0u), from) - ground[g].offset, sinks = -dot(LOAD3(ground[g].normal, 0u), gone);
  double room = height - double(0.02) * gap;
  return sinks > room ? double(0.99) * max(room, double(0)) / sinks : double(1);
}

// What static bodies and grounds have given in this step.
void tell_outside_impulse() {
  for (uint k = 0u; k < 3u; ++k) {
    if (was_made()) outside_impulse[k] += quantum() * whole_of(outside_sum[k]);
    outside_sum[k] = uvec2(0u);
  }
}

void expect_cuts(uint i) {
  if (i == 0u) {
    tell_outside_impulse();
    contact_list[0].arrivals &= waited_in_vain;
  }
  uint b = uint(rest_position[i].w);
  uint before = displacement_of(in_half(from_half, vertex_count, i)), after = displacement_of(in_half(other_half(from_half), vertex_count, i));
  bool is_movable = surface[b].inverse_mass != double(0);
  dvec3 gone = dvec3(0);
  if (!was_made()) STORE3(motion, velocity_of(in_half(other_half(from_half), vertex_count, i)), LOAD3(unkicked, force_of(i)))
  if (is_movable) gone = rotate(pose[b], LOAD3(motion, after) - LOAD3(motion, before));
  STORE3(way, force_of(i), gone)
  dvec3 from = LOAD3(start, start_position_of(i));
  double part = double(1);
  for (int k = 0; k < 3; ++k)
    part = min(part, part_to(from[k], gone[k], double(cage[lower_of(i)][k]), double(cage[upper_of(i)][k])));
  for (uint g = 0u; g < ground_count; ++g)
    if (is_movable) part = min(part, part_above(g, from, gone, mean_of_pair(surface[b].gap, ground[g].gap) * surface[b].edge));
  cut[i] = is_movable ? floatBitsToUint(float(part) * (part < double(1) ? 0.999999f : 1.0f)) : 0u;
  for (uint k = 1u; k <= cut_rounds; ++k) cut[k * vertex_count + i] = floatBitsToUint(1.0f);
}
