// A group kernel. It sums what pulls the nodes of a cluster: the vertices of far clusters, less what those clusters' nodes pull. From that
// follows what the cluster's own vertices get. It runs behind sum_leaf_springs.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
#include "../physics/forces/spring.glsl"
READ(body)
READ(status)
READ(spring_cluster)
READ(far_cluster)
READ_AS(spring_point, real4, point)
READ(node_pull)
WRITE(cluster_pull)
PARAMETER(uint, place_count)
#include "parts/sums_clusters.glsl"
NEAR(real, part, 64u * pulls_size)  // [thread][node][3]
NEAR(real, all, pulls_size)

real3 pull_between(uint own, uint other) {
  real4 place = point[place_of_point(other)];
  real3 x = real3(point[place_of_point(own)]) - real3(place);
  real3 d = real3(point[displacement_of_point(own)]) - real3(point[displacement_of_point(other)]);
  return (place.w * spring_strain(x, d)) * x;
}

void take_off(uint node, real3 pull) {
  uint at = pulls_size * THREAD + 3u * node;
  part[at] -= pull.x;
  part[at + 1u] -= pull.y;
  part[at + 2u] -= pull.z;
}

// What a node pulls vertices with, they pull it with the other way.
void take_off_vertices(uint first, uint end) {
  uint passed = 0u;  // pulls by clusters before
  for (uint p = first, i = THREAD; p < end;) {
    uvec4 far = far_cluster[p];
    if (i - passed >= far.y * far.w) {
      passed += far.y * far.w;
      ++p;
      continue;
    }
    uint k = (i - passed) / far.w, at = node_pull_of(far.z, k, far.w, (i - passed) % far.w);
    take_off(first_node(far.y) + k, real3(node_pull[at], node_pull[at + 1u], node_pull[at + 2u]));
    i += THREADS;
  }
}

void take_off_nodes(uint c, uint first, uint end) {
  uint passed = 0u;  // pairs of nodes before
  for (uint p = first, i = THREAD; p < end;) {
    uvec4 far = far_cluster[p];
    if (i - passed >= far.y * far.y) {
      passed += far.y * far.y;
      ++p;
      continue;
    }
    uint own = first_node(far.y) + (i - passed) / far.y, other = first_node(far.y) + (i - passed) % far.y;
    take_off(own, pull_between(point_of_node(place_count, c, own), point_of_node(place_count, far.x, other)));
    i += THREADS;
  }
}

void sum_parts() {
  for (uint k = THREAD; k < pulls_size; k += THREADS) {
    real sum = real(0);
    for (uint thread = 0u; thread < THREADS; ++thread) sum += part[pulls_size * thread + k];
    all[k] = sum;
  }
}

void keep_pulls(uint c, double unit) {
  dvec3 sum = LOAD3(all, 0u), x_sum = dvec3(0), y_sum = dvec3(0), z_sum = dvec3(0);
  for (uint node = 1u; node < nodes_of_cluster; ++node) {
    dvec3 pull = LOAD3(all, 3u * node) / double(4), slope = unit * LOAD3(spring_cluster[c].gradient, 3u * (node - 1u));
    sum += pull;
    x_sum += slope.x * pull;
    y_sum += slope.y * pull;
    z_sum += slope.z * pull;
  }
  uint at = moments_size * c;
  STORE3(cluster_pull, at, sum)
  STORE3(cluster_pull, at + 3u, x_sum)
  STORE3(cluster_pull, at + 6u, y_sum)
  STORE3(cluster_pull, at + 9u, z_sum)
}

void sum_node_pulls(uint c) {
  uint b = spring_cluster[c].body_index, first = spring_cluster[c].first_partner, end = spring_cluster[c].end_partner;
  if (!sums_clusters(b) || first == end) return;
  for (uint k = 0u; k < pulls_size; ++k) part[pulls_size * THREAD + k] = real(0);
  take_off_vertices(first, end);
  take_off_nodes(c, first, end);
  MEET
  sum_parts();
  MEET
  if (THREAD == 0u) keep_pulls(c, double(1) / body[b].inverse_unit);
}
