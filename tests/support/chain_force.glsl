// A force of the tests' own. One thread adds springs from one vertex to those before and after it in its body's list. They act beside
// the body's own springs.
#include "physics/body.glsl"
#include "physics/forces/spring.glsl"
#include "physics/layout.glsl"
READ(body)
READ(rest_position)
READ_AS(placement, real4, placed)
WRITE(added_force)
PARAMETER(uint, vertex_count)
PARAMETER(uint, slot)
PARAMETER(uint, is_first)
PARAMETER(uint, chained_body)
PARAMETER(double, chain_stiffness)  // [N/m]
#include "kernels/parts/add_force.glsl"

dvec3 link_force(uint i, uint j, double unit_force) {
  real3 x = real3(placed[position_at(slot, vertex_count, i)]) - real3(placed[position_at(slot, vertex_count, j)]);
  real3 d = real3(placed[displacement_at(slot, vertex_count, i)]) - real3(placed[displacement_at(slot, vertex_count, j)]);
  return (-unit_force * double(spring_strain(x, d))) * dvec3(x);
}

void chain_force(uint i) {
  uint b = uint(rest_position[i].w);
  dvec3 force = dvec3(0);
  if (b == chained_body) {
    double unit_force = chain_stiffness / body[b].inverse_unit;
    if (i > body[b].first_vertex) force += link_force(i, i - 1u, unit_force);
    if (i + 1u < body[b].first_vertex + body[b].vertex_count) force += link_force(i, i + 1u, unit_force);
  }
  add_force(i, force);
}
