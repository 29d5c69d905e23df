// One thread takes the vertices of one leaf into the tree's order, and sums their moments. It runs before a stage.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
#include "../physics/layout.glsl"
READ(body)
READ(status)
READ(rest_position)
READ_AS(placement, real4, placed)
READ(spring_cluster)
READ(spring_leaf)
READ(tree_vertex)
WRITE_AS(spring_point, real4, point)
WRITE(leaf_moment)
PARAMETER(uint, vertex_count)
PARAMETER(uint, slot)
#include "parts/sums_clusters.glsl"

void sum_leaf_moments(uint leaf) {
  uint b = spring_leaf[leaf].x;
  if (!sums_clusters(b)) return;
  dvec3 centre = LOAD3(spring_cluster[spring_leaf[leaf].y].centre, 0u);
  double inverse_unit = body[b].inverse_unit;
  real3 sum = real3(0), x_sum = real3(0), y_sum = real3(0), z_sum = real3(0);
  for (uint k = 0u; k < leaf_size; ++k) {
    uint place = leaf_size * leaf + k, i = tree_vertex[place];
    real weight = k < spring_leaf[leaf].w ? real(1) : real(0);
    real3 x = real3(placed[position_at(slot, vertex_count, i)]), u = real3(placed[displacement_at(slot, vertex_count, i)]);
    real3 arm = real3((dvec3(rest_position[i]) - centre) * inverse_unit);
    point[place_of_point(place)] = real4(x, weight);
    point[displacement_of_point(place)] = real4(u, real(0));
    u *= weight;
    sum += u;
    x_sum += arm.x * u;
    y_sum += arm.y * u;
    z_sum += arm.z * u;
  }
  uint at = moments_size * leaf;
  STORE3(leaf_moment, at, sum)
  STORE3(leaf_moment, at + 3u, x_sum)
  STORE3(leaf_moment, at + 6u, y_sum)
  STORE3(leaf_moment, at + 9u, z_sum)
}
