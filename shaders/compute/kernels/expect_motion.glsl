// One thread serves one vertex at a step's start. It finds where the vertex is and how it is expected to move. It bounds both by a cage
// that the vertex will not leave in this step, and its expected way by another box.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
WRITE(control)
READ(step_parts)
READ(pose)
READ(surface)
READ(room)
READ(rest_position)
READ(motion)
READ(surplus)
WRITE(start)
WRITE(unkicked)
WRITE(expected)
WRITE(cage)
WRITE(contact_list)
WRITE(contact_weight)
WRITE(body_box)
WRITE(status)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, from_half)
#include "parts/bound.glsl"

void empty_lists() {
  contact_list[0].triangle_pair_count = 0u;
  contact_list[0].contact_count = 0u;
  contact_list[0].uncertified = 0u;
  contact_list[0].changed_rounds = 0u;
  contact_list[0].arrivals &= waited_in_vain;
  contact_list[0].presses = 0u;
  contact_list[0].has_cuts = 0u;
}

// How much further than expected a vertex may go. Bodies that are far from all others have more room. Those that are hit need more, because
// a kick changes what is expected: half an edge is what a heavy body gives to a light one by a quarter edge a step.
double reach_beyond(uint b, double time_step) {
  double edge = surface[b].edge, pushed = min(time_step * double(uintBitsToFloat(room[body_count + b])), double(0.5) * edge);
  return clamp(double(uintBitsToFloat(room[b])), reach_in_edges() * edge + pushed, double(1000) * edge);
}

void expect_motion(uint i) {
  uint b = uint(rest_position[i].w), at = in_half(from_half, vertex_count, i);
  dvec3 position = to_world(pose[b], dvec3(vec3(rest_position[i])) + LOAD3(motion, displacement_of(at)));
  dvec3 in_frame = LOAD3(motion, velocity_of(at)), velocity = rotate(pose[b], in_frame);
  dvec3 latest = LOAD3(surplus, surplus_of(0u, vertex_count, i)), before = LOAD3(surplus, surplus_of(1u, vertex_count, i));
  double time_step = next_part(step_parts[0]);
  double longer = step_parts[0].last > double(0) ? time_step / step_parts[0].last : double(1);
  if (i == 0u) {
    control[0].time_step = time_step;
    contact_list[0].longer = longer;
    empty_lists();
  }
  dvec3 mean = velocity + longer * (latest + double(0.5) * (latest - before));
  STORE3(start, start_position_of(i), position)
  STORE3(start, start_velocity_of(i), velocity)
  STORE3(unkicked, force_of(i), in_frame)
  STORE3(expected, force_of(i), mean)
  contact_weight[i] = 0u;
  dvec3 reach = abs(time_step * mean);
  if (surface[b].inverse_mass != double(0)) reach += dvec3(reach_beyond(b, time_step));
  // rounded outward: a float is off by at most 2^-24 of itself, whichever way it is rounded
  dvec3 slack = abs(position) * double(2.4e-7) + reach * double(1.2e-7);
  dvec3 lower = position - reach - slack, upper = position + reach + slack;
  cage[cage_of(i)] = vec4(vec3(lower), 0);
  cage[cage_of(i) + 1u] = vec4(vec3(upper), 0);
  dvec3 end = position + time_step * mean, near = dvec3(surface[b].nearness) + slack;
  cage[way_box_of(i)] = vec4(vec3(min(position, end) - near), 0);
  cage[way_box_of(i) + 1u] = vec4(vec3(max(position, end) + near), 0);
  for (uint k = 0u; k < 3u; ++k) {
    bound(i, b, k, float(lower[int(k)]));
    bound(i, b, k, float(upper[int(k)]));
  }
  uint speed = floatBitsToUint(float(length(mean)));
  if (surface[b].inverse_mass != double(0)) RAISE_TO(contact_list[0].fastest, speed)
}
