// One thread gives one vertex the sum of its contacts' impulses, which changes its velocity alone.
#include "../physics/body.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/exact_sum.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
READ(pose)
READ(surface)
WRITE(status)
READ(rest_position)
WRITE(motion)
WRITE(impulse_sum)
WRITE(contact_weight)
WRITE(outside_sum)
WRITE(pressed)
READ(step_parts)
READ(contact_list)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)
PARAMETER(double, least_speed)
PARAMETER(double, heaviest_vertex)
#include "parts/impulse_sums.glsl"

void kick_vertices(uint i) {
  if (contact_weight[i] == 0u) return;
  contact_weight[i] = 0u;
  dvec3 quanta = impulse_on(buffer_of(kick_rounds), i);
  for (uint k = 0u; k < sum_buffers; ++k) clear_impulse(k, i);
  uint b = uint(rest_position[i].w);
  if (quanta == dvec3(0) || surface[b].inverse_mass == double(0)) return;
  uint at = velocity_of(in_half(from_half, vertex_count, i));
  dvec3 velocity = LOAD3(motion, at) + (surface[b].inverse_mass * quantum()) * rotate_back(pose[b], quanta);
  STORE3(motion, at, velocity)
  ATOMIC_STORE(status[b].deformed, 1u);
  ATOMIC_STORE(pressed[b], step_parts[0].parts + 1u);
  for (uint k = 0u; k < 3u; ++k)
    if (quanta[int(k)] != double(0)) ADD_EXACTLY(outside_sum[k], quanta[int(k)])
}
