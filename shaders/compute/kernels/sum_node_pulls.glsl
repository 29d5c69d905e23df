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
READ_AS(node_pull, real4, pulls)
WRITE(cluster_pull)
PARAMETER(uint, place_count)
#include "parts/sums_clusters.glsl"
NEAR(real, all, pulls_size)  // [node][3]: what pulls them, with its sign changed

#ifdef __cplusplus
void sum_pulls(uint c) {
  const SpringCluster& cluster = spring_cluster[c];
  functions.sum_nodes({.points = &point->x,
                       .place_count = place_count,
                       .cluster = c,
                       .far = {.clusters = &far_cluster->x + std::size_t{2} * cluster.first_far,
                               .count = cluster.end_far - cluster.first_far,
                               .one_count = cluster.first_far_four - cluster.first_far},
                       .node_pulls = &pulls->x + std::size_t{pull_row_size} * cluster.first_pull,
                       .leaf_pulls_on_one = cluster.leaf_pulls_on_one,
                       .row_count = cluster.end_pull - cluster.first_pull,
                       .sums = all});
}

const cpu::ClusterFunctions<real> functions = cpu::cluster_functions<real>(cpu::available_isas().back());
#else
NEAR(real, part, bank_row * pulls_size)  // [node][3][thread]
NEAR(real, quarter, 4u * pulls_size)     // sums of 16 threads each

real3 pull_between(uint own, uint other) {
  real4 place = point[place_of_point(other)];
  real3 x = real3(point[place_of_point(own)]) - real3(place);
  real3 d = real3(point[displacement_of_point(own)]) - real3(point[displacement_of_point(other)]);
  return (place.w * spring_strain(x, d)) * x;
}

void store_part(uint node, real3 sum) {
  uint at = bank_row * 3u * node + THREAD;
  part[at] = sum.x;
  part[at + bank_row] = sum.y;
  part[at + 2u * bank_row] = sum.z;
}

// A thread has one of a cluster's four nodes to itself, because there are 16 pairs of nodes for each far cluster.
void sum_pulls(uint c) {
  uint first_far = spring_cluster[c].first_far, first_four = spring_cluster[c].first_far_four, end_far = spring_cluster[c].end_far;
  real3 sum0 = real3(0), sum1 = real3(0), sum2 = real3(0), sum3 = real3(0), sum4 = real3(0), of_own = real3(0);
  // With a loop each for rows of node 0 and for others, llvmpipe of Mesa 22.3.6 adds to the wrong sums.
  uint first_row = spring_cluster[c].first_pull, end = spring_cluster[c].end_pull, ones = spring_cluster[c].leaf_pulls_on_one;
  for (uint r = first_row + THREAD; r < end; r += THREADS) {
    real4 some = pulls[3u * r], more = pulls[3u * r + 1u], last = pulls[3u * r + 2u];
    real3 first = real3(some), second = real3(some.w, more.x, more.y), third = real3(more.z, more.w, last.x);
    real3 fourth = real3(last.y, last.z, last.w);
    uint passed = 4u * (r - first_row);  // pulls on node 0
    if (passed < ones) {
      uint left = ones - passed;
      real3 none = real3(0);  // which a row may lack
      sum0 += (first + (left > 1u ? second : none)) + ((left > 2u ? third : none) + (left > 3u ? fourth : none));
    } else {
      sum1 += first;
      sum2 += second;
      sum3 += third;
      sum4 += fourth;
    }
  }
  for (uint p = first_far + THREAD; p < first_four; p += THREADS)
    sum0 += pull_between(point_of_node(place_count, c, 0u), point_of_node(place_count, far_cluster[p].x, 0u));
  uint own = 1u + THREAD % 16u / 4u, other = 1u + THREAD % 4u;
  for (uint i = THREAD; i < 16u * (end_far - first_four); i += THREADS)
    of_own += pull_between(point_of_node(place_count, c, own), point_of_node(place_count, far_cluster[first_four + i / 16u].x, other));
  if (own == 1u) sum1 += of_own;
  if (own == 2u) sum2 += of_own;
  if (own == 3u) sum3 += of_own;
  if (own == 4u) sum4 += of_own;
  store_part(0u, sum0);
  store_part(1u, sum1);
  store_part(2u, sum2);
  store_part(3u, sum3);
  store_part(4u, sum4);
  MEET
  for (uint k = THREAD; k < 4u * pulls_size; k += THREADS) {  // quarters of rows
    uint first = bank_row * (k / 4u) + 16u * (k % 4u);
    real4 sums = real4(0);
    for (uint thread = first; thread < first + 16u; thread += 4u)
      sums += real4(part[thread], part[thread + 1u], part[thread + 2u], part[thread + 3u]);
    quarter[k] = (sums.x + sums.y) + (sums.z + sums.w);
  }
  MEET
  for (uint k = THREAD; k < pulls_size; k += THREADS)
    all[k] = (quarter[4u * k] + quarter[4u * k + 1u]) + (quarter[4u * k + 2u] + quarter[4u * k + 3u]);
}
#endif

// Returns a coordinate of what the nodes pull a vertex with, or of what they do for its place along the axis `row` - 1.
double pull_by(uint c, uint row, uint axis, double unit) {
  dvec3 of_place = dvec3(0);
  double sum = double(0);
  for (uint node = 1u; node < nodes_of_cluster; ++node) sum += double(all[3u * node + axis]);
  for (uint m = 0u; m < 3u; ++m) {
    double along = double(0);
    for (uint node = 1u; node < nodes_of_cluster; ++node) along += side_of_node(node, m) * double(all[3u * node + axis]);
    of_place += along * LOAD3(spring_cluster[c].slope, 3u * m);
  }
  if (row > 0u) return unit * of_place[row - 1u] / double(4);
  return (sum - dot(of_place, LOAD3(spring_cluster[c].centre, 0u))) / double(4) + double(all[axis]);
}

void sum_node_pulls(uint c) {
  uint b = spring_cluster[c].body_index;
  if (!sums_clusters(b) || spring_cluster[c].first_far == spring_cluster[c].end_far) return;
  sum_pulls(c);
  MEET
  for (uint k = THREAD; k < moments_size; k += THREADS) {
    double pull = pull_by(c, k / 3u, k % 3u, double(1) / body[b].inverse_unit);
    cluster_pull[moments_size * c + k] = -pull;
  }
}
