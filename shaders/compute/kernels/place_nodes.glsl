// A group kernel. It places the nodes of a cluster that others see. It runs behind sum_leaf_moments.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
READ(body)
READ(status)
READ(spring_cluster)
READ(spring_leaf)
READ(leaf_moment)
WRITE_AS(spring_point, real4, point)
PARAMETER(uint, place_count)
#include "parts/sums_clusters.glsl"
NEAR(real, part, moments_size * 64u)  // [thread][12]
NEAR(real, all, moments_size)

real3 moment_of(uint leaf, uint row) {
  uint at = moments_size * leaf + 3u * row;
  return real3(leaf_moment[at], leaf_moment[at + 1u], leaf_moment[at + 2u]);
}

real3 all_of(uint row) { return real3(all[3u * row], all[3u * row + 1u], all[3u * row + 2u]); }

// Sums the moments of every THREADS-th leaf, about the cluster's centre.
void sum_leaves(uint c, dvec3 centre, double inverse_unit) {
  real3 sum = real3(0), x_sum = real3(0), y_sum = real3(0), z_sum = real3(0);
  for (uint leaf = spring_cluster[c].first_leaf + THREAD; leaf < spring_cluster[c].end_leaf; leaf += THREADS) {
    real3 way = real3((LOAD3(spring_cluster[spring_leaf[leaf].y].centre, 0u) - centre) * inverse_unit);
    real3 of_leaf = moment_of(leaf, 0u);
    sum += of_leaf;
    x_sum += moment_of(leaf, 1u) + way.x * of_leaf;
    y_sum += moment_of(leaf, 2u) + way.y * of_leaf;
    z_sum += moment_of(leaf, 3u) + way.z * of_leaf;
  }
  uint at = moments_size * THREAD;
  STORE3(part, at, sum)
  STORE3(part, at + 3u, x_sum)
  STORE3(part, at + 6u, y_sum)
  STORE3(part, at + 9u, z_sum)
}

void sum_parts() {
  for (uint k = THREAD; k < moments_size; k += THREADS) {
    real sum = real(0);
    for (uint thread = 0u; thread < THREADS; ++thread) sum += part[moments_size * thread + k];
    all[k] = sum;
  }
}

void place_node(uint c, uint node, dvec3 centre, double inverse_unit) {
  dvec3 offset = dvec3(0), gradient = dvec3(0);
  if (node > 0u) {
    offset = LOAD3(spring_cluster[c].offset, 3u * (node - 1u));
    gradient = LOAD3(spring_cluster[c].gradient, 3u * (node - 1u));
  }
  real3 slope = real3(gradient / inverse_unit);
  real count = real(spring_cluster[c].vertex_count);
  real3 u = (all_of(0u) + slope.x * all_of(1u) + slope.y * all_of(2u) + slope.z * all_of(3u)) / count;
  uint at = point_of_node(place_count, c, node);
  real weight = node == 0u ? count : count / real(4);
  point[place_of_point(at)] = real4(real3((centre + offset) * inverse_unit + dvec3(u)), weight);
  point[displacement_of_point(at)] = real4(u, real(0));
}

void place_nodes(uint c) {
  uint b = spring_cluster[c].body_index;
  if (!sums_clusters(b) || spring_cluster[c].first_far == spring_cluster[c].end_far) return;
  dvec3 centre = LOAD3(spring_cluster[c].centre, 0u);
  sum_leaves(c, centre, body[b].inverse_unit);
  MEET
  sum_parts();
  MEET
  for (uint node = THREAD; node < nodes_of_cluster; node += THREADS) place_node(c, node, centre, body[b].inverse_unit);
}
