// A group kernel. It sums the springs of a leaf's vertices to vertices of near leaves, and to nodes of far clusters. For each node it also
// keeps what that pulls the leaf's vertices with. It runs behind place_nodes. Threads share what is seen, and each serves all vertices of the
// leaf.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
#include "../physics/forces/spring.glsl"
READ(status)
READ(spring_cluster)
READ(spring_leaf)
READ(near_begin)
READ(near_leaf)
READ(far_node)
READ_AS(spring_point, real4, point)
WRITE(leaf_pull)
WRITE(node_pull)
#include "parts/sums_clusters.glsl"

#ifdef __cplusplus
void sum_leaf_springs(uint leaf) {
  const uvec4 own_leaf = spring_leaf[leaf];
  if (!sums_clusters(own_leaf.x)) return;
  std::array<cpu::SeenNodes<real>, 40> seen;  // for a tree of 2^32 vertices, and more
  uint seen_count = 0u;
  for (uint c = own_leaf.y; c != no_cluster; c = spring_cluster[c].parent) {
    const SpringCluster& cluster = spring_cluster[c];
    const uint leaf_count = cluster.end_leaf - cluster.first_leaf;
    if (cluster.first_far < cluster.end_far)
      seen[seen_count++] = {.points = far_node + cluster.first_far,
                            .count = cluster.end_far - cluster.first_far,
                            .stride = 3u * leaf_count,
                            .pulls = node_pull + node_pull_of(cluster.first_node_pull, 0u, leaf_count, leaf - cluster.first_leaf)};
  }
  sum_leaf({.points = &point->x,
            .leaf = leaf,
            .near_leaves = near_leaf + near_begin[leaf],
            .near_count = near_begin[leaf + 1u] - near_begin[leaf],
            .seen = seen.data(),
            .seen_count = seen_count,
            .pulls = leaf_pull + 3u * leaf_size * leaf});
}

const cpu::LeafFunction<real> sum_leaf = cpu::leaf_function<real>(cpu::available_isas().back());
#else
#define EACH_OWN(f) f(0) f(1) f(2) f(3) f(4) f(5) f(6) f(7) f(8) f(9) f(10) f(11) f(12) f(13) f(14) f(15)
NEAR(real, part, 64u * 3u * leaf_size)  // [thread][vertex][3]

void store_pull(uint at, real3 pull) { STORE3(part, at, pull) }

void sum_leaf_springs(uint leaf) {
  uvec4 own_leaf = spring_leaf[leaf];
  if (!sums_clusters(own_leaf.x)) return;
#define OWN(k)                                                                                            \
  uint own##k = leaf_size * leaf + uint(k);                                                               \
  real3 u##k = real3(point[displacement_of_point(own##k)]), x##k = real3(point[place_of_point(own##k)]), pull##k = real3(0); \
  real weight##k = point[place_of_point(own##k)].w;
  EACH_OWN(OWN)
  for (uint k = THREAD; k < leaf_size * (near_begin[leaf + 1u] - near_begin[leaf]); k += THREADS) {
    uint other = leaf_size * near_leaf[near_begin[leaf] + k / leaf_size] + k % leaf_size;
    real4 place = point[place_of_point(other)];
    real3 u = real3(point[displacement_of_point(other)]);
#define SEE_VERTEX(n) pull##n += (place.w * spring_strain(x##n - real3(place), u##n - u)) * (x##n - real3(place));
    EACH_OWN(SEE_VERTEX)
  }
  uint passed = 0u;  // nodes that clusters below have seen
  for (uint c = own_leaf.y, k = THREAD; c != no_cluster;) {
    uint count = spring_cluster[c].end_far - spring_cluster[c].first_far;
    if (k - passed >= count) {
      passed += count;
      c = spring_cluster[c].parent;
      continue;
    }
    uint other = far_node[spring_cluster[c].first_far + (k - passed)];
    real4 place = point[place_of_point(other)];
    real3 u = real3(point[displacement_of_point(other)]), back = real3(0);
#define SEE_NODE(n)                                                                                 \
  {                                                                                                  \
    real3 pull = spring_strain(x##n - real3(place), u##n - u) * (x##n - real3(place));               \
    pull##n += place.w * pull;                                                                       \
    back += weight##n * pull;                                                                        \
  }
    EACH_OWN(SEE_NODE)
    uint at = node_pull_of(spring_cluster[c].first_node_pull, k - passed, spring_cluster[c].end_leaf - spring_cluster[c].first_leaf,
                           leaf - spring_cluster[c].first_leaf);
    STORE3(node_pull, at, back)
    k += THREADS;
  }
#define KEEP(n) store_pull(3u * (leaf_size * THREAD + uint(n)), pull##n);
  EACH_OWN(KEEP)
  MEET
  for (uint k = THREAD; k < 3u * leaf_size; k += THREADS) {
    real sum = real(0);
    for (uint thread = 0u; thread < THREADS; ++thread) sum += part[3u * leaf_size * thread + k];
    leaf_pull[3u * leaf_size * leaf + k] = sum;
  }
}
#endif
