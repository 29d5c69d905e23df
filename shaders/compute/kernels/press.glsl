// One thread adds the force of the pressure inside a body to one vertex. It runs before a stage and after sum_volume.
#include "../physics/body.glsl"
#include "../physics/forces/pressure.glsl"
#include "../physics/layout.glsl"
READ(body)
READ(rest_position)
READ_AS(placement, real4, placed)
READ(pressure)
READ(volume_part)
READ(fan_begin)
READ(fan)
WRITE(added_force)
PARAMETER(uint, vertex_count)
PARAMETER(uint, slot)
PARAMETER(uint, is_first)
#include "parts/add_force.glsl"

dvec3 place_of(uint i) { return dvec3(real3(placed[position_at(slot, vertex_count, i)])); }

// Returns the body's volume [m^3]. Every vertex of a body sums its parts in the same order.
double volume_of(uint b) {
  double volume = double(0);
  for (uint k = 0u; k < pressure[b].part_count; ++k) volume += volume_part[pressure[b].first_part + k];
  return volume;
}

// Returns the volume's derivative by the vertex's position [body's unit squared].
dvec3 gradient_at(uint i) {
  dvec3 place = place_of(i), gradient = dvec3(0);
  for (uint k = fan_begin[i]; k < fan_begin[i + 1u]; ++k)
    gradient += volume_gradient(place, place_of(fan[k].x), place_of(fan[k].y));
  return gradient;
}

void press(uint i) {
  uint b = uint(rest_position[i].w);
  dvec3 force = dvec3(0);
  if (pressure[b].at_rest != double(0)) {
    double inverse_unit = body[b].inverse_unit;
    force = (pressure_at(pressure[b], volume_of(b)) / (inverse_unit * inverse_unit)) * gradient_at(i);
  }
  add_force(i, force);
}
