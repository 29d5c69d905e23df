// One thread sums what some triangles of a closed body add to its volume. It runs before a stage.
#include "../physics/body.glsl"
#include "../physics/forces/pressure.glsl"
#include "../physics/layout.glsl"
READ(body)
READ_AS(placement, real4, placed)
READ(shell_part)
READ(shell_triangle)
WRITE(volume_part)
PARAMETER(uint, vertex_count)
PARAMETER(uint, slot)

dvec3 corner(uint t, uint k) { return dvec3(real3(placed[position_at(slot, vertex_count, shell_triangle[corner_of(t, k)])])); }

void sum_volume(uint item) {
  uvec4 part = shell_part[item];
  double volume = double(0);
  for (uint t = part.y; t < part.z; ++t) volume += volume_below(corner(t, 0u), corner(t, 1u), corner(t, 2u));
  double inverse_unit = body[part.x].inverse_unit;
  volume_part[item] = volume / (inverse_unit * inverse_unit * inverse_unit);
}
