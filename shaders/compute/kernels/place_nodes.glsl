// A group kernel. It places the nodes of a cluster that others see. It runs behind sum_leaf_moments.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
READ(body)
READ(status)
READ(spring_cluster)
READ(leaf_moment)
WRITE(spring_point)
PARAMETER(uint, place_count)
#include "parts/sums_clusters.glsl"
NEAR(double, part, 64u)  // for 64 threads at most
NEAR(double, all, moments_size)

// Sums the moments of leaves, of which several rows of threads take turns.
void sum_leaves(uint first, uint end) {
  uint rows = max(THREADS / moments_size, 1u);
  for (uint k = THREAD; k < rows * moments_size; k += THREADS) {
    double sum = double(0);
    for (uint leaf = first + k / moments_size; leaf < end; leaf += rows) sum += leaf_moment[moments_size * leaf + k % moments_size];
    part[k] = sum;
  }
  MEET
  for (uint k = THREAD; k < moments_size; k += THREADS) {
    double sum = double(0);
    for (uint row = 0u; row < rows; ++row) sum += part[moments_size * row + k];
    all[k] = sum;
  }
  MEET
}

// Places one coordinate of a node. forces/clusters.glsl says where nodes stand and how they move.
void place_node(uint c, uint node, uint axis, double inverse_unit) {
  double place = spring_cluster[c].centre[axis], sum = all[axis];
  real count = real(spring_cluster[c].vertex_count);
  if (node > 0u) {
    dvec3 moments = dvec3(all[3u + axis], all[6u + axis], all[9u + axis]) / inverse_unit - sum * LOAD3(spring_cluster[c].centre, 0u);
    for (uint m = 0u; m < 3u; ++m) {
      place += side_of_node(node, m) * spring_cluster[c].squares[m] * spring_cluster[c].slope[3u * m + axis];
      sum += side_of_node(node, m) * dot(LOAD3(spring_cluster[c].slope, 3u * m), moments);
    }
  }
  double u = sum / double(spring_cluster[c].vertex_count);
  uint first = 4u * place_of_point(point_of_node(place_count, c, node));
  spring_point[first + axis] = real(place * inverse_unit + u);
  spring_point[first + 4u + axis] = real(u);
  if (axis == 0u) spring_point[first + 3u] = node == 0u ? count : count / real(4);
}

void place_nodes(uint c) {
  uint b = spring_cluster[c].body_index;
  if (!sums_clusters(b) || spring_cluster[c].first_far == spring_cluster[c].end_far) return;
  sum_leaves(spring_cluster[c].first_leaf, spring_cluster[c].end_leaf);
  for (uint k = THREAD; k < 3u * nodes_of_cluster; k += THREADS) place_node(c, k / 3u, k % 3u, body[b].inverse_unit);
}
