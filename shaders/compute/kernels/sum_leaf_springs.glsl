// A group kernel. It sums the springs of a leaf's vertices to vertices of near leaves, and to nodes of far clusters. For each node it also
// keeps what that pulls the leaf's vertices with. It runs behind place_nodes. Threads share what is seen, and each serves all vertices of the
// leaf.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
#include "../physics/forces/spring.glsl"
READ(status)
READ(spring_cluster)
READ(spring_leaf)
READ(near_leaf)
READ(above_cluster)
READ(far_cluster)
READ_AS(spring_point, real4, point)
WRITE(leaf_pull)
WRITE(node_pull)
PARAMETER(uint, place_count)
#include "parts/sums_leaf.glsl"

#ifdef __cplusplus
void sum_leaf_springs(uint item) {
  uint leaf = first_leaf + item;
  if (!sums_leaf(leaf)) return;
  const uvec4 begin = spring_leaf[leaf], end = spring_leaf[leaf + 1u];
  std::array<cpu::FarClusters, most_above> seen;
  std::array<std::uint32_t, most_above> own_places;
  for (uint k = begin.w; k < end.w; ++k) {
    const SpringCluster& cluster = spring_cluster[above_cluster[k]];
    seen[k - begin.w] = {.clusters = &far_cluster->x + std::size_t{2} * cluster.first_far,
                         .count = cluster.end_far - cluster.first_far,
                         .one_count = cluster.first_far_four - cluster.first_far};
    own_places[k - begin.w] = leaf - cluster.first_leaf;
  }
  functions.sum_leaf({.points = &point->x,
                      .place_count = place_count,
                      .leaf = leaf,
                      .near_leaves = near_leaf + begin.z,
                      .near_count = end.z - begin.z,
                      .seen = seen.data(),
                      .own_places = own_places.data(),
                      .seen_count = end.w - begin.w,
                      .pulls = leaf_pull + 3u * leaf_size * leaf,
                      .node_pulls = node_pull});
}

const cpu::ClusterFunctions<real> functions = cpu::cluster_functions<real>(cpu::available_isas().back());
#else
const uint batch = 4u;                        // vertices of the leaf whose sums threads add up at a time: less memory lets more groups run
const uint folded = places_of_tile / 2u;      // threads have sums there, after others have added theirs
const uint row = folded + 1u;                 // so that rows begin in different banks
NEAR(real4, own_point, 2u * leaf_size)
NEAR(uvec4, seen, most_above)                 // of each cluster above: first_far, first_far_four, end_far, the leaf's place in it
NEAR(real, part, row * 3u * batch)            // [vertex][3][thread]
#define BATCH_0(f) f(0) f(1) f(2) f(3)
#define BATCH_1(f) f(4) f(5) f(6) f(7)
#define BATCH_2(f) f(8) f(9) f(10) f(11)
#define BATCH_3(f) f(12) f(13) f(14) f(15)
#define EACH_OWN(f) BATCH_0(f) BATCH_1(f) BATCH_2(f) BATCH_3(f)

uint nodes_seen(uint level) { return (seen[level].y - seen[level].x) + 4u * (seen[level].z - seen[level].y); }

void sum_parts(uint first) {
  for (uint k = THREAD; k < 3u * batch; k += THREADS) {
    real4 sums = real4(0);
    for (uint thread = 0u; thread < folded; thread += 4u) {
      uint at = row * k + thread;
      sums += real4(part[at], part[at + 1u], part[at + 2u], part[at + 3u]);
    }
    leaf_pull[first + k] = (sums.x + sums.y) + (sums.z + sums.w);
  }
}

void sum_leaf_springs(uint item) {
  uint leaf = first_leaf + item;
  if (!sums_leaf(leaf)) return;
  uvec4 begin = spring_leaf[leaf];
  uint near_end = spring_leaf[leaf + 1u].z, levels = spring_leaf[leaf + 1u].w - begin.w;
  for (uint k = THREAD; k < 2u * leaf_size; k += THREADS) own_point[k] = point[place_of_point(leaf_size * leaf) + k];
  for (uint k = THREAD; k < levels; k += THREADS) {
    uint c = above_cluster[begin.w + k];
    seen[k] = uvec4(spring_cluster[c].first_far, spring_cluster[c].first_far_four, spring_cluster[c].end_far,
                    leaf - spring_cluster[c].first_leaf);
  }
  MEET
#define CLEAR(n) real3 pull##n = real3(0);
  EACH_OWN(CLEAR)
  for (uint k = THREAD; k < leaf_size * (near_end - begin.z); k += THREADS) {
    uint other = leaf_size * near_leaf[begin.z + k / leaf_size] + k % leaf_size;
    real4 place = point[place_of_point(other)];
    real3 u = real3(point[displacement_of_point(other)]);
#define SEE_VERTEX(n)                                                                                          \
  {                                                                                                            \
    real3 x = real3(own_point[2 * n]) - real3(place);                                                          \
    real strain = place.w * spring_strain(x, real3(own_point[2 * n + 1]) - u);                                 \
    pull##n = real3(FUSED(strain, x.x, pull##n.x), FUSED(strain, x.y, pull##n.y), FUSED(strain, x.z, pull##n.z)); \
  }
    EACH_OWN(SEE_VERTEX)
  }
  uint node_count = 0u;
  for (uint level = 0u; level < levels; ++level) node_count += nodes_seen(level);
  for (uint k = THREAD, level = 0u, passed = 0u; k < node_count; k += THREADS) {  // `passed` counts nodes of levels below
    while (k - passed >= nodes_seen(level)) passed += nodes_seen(level++);
    uvec4 of_level = seen[level];
    uint ones = of_level.y - of_level.x, place_in_level = k - passed;
    bool is_one = place_in_level < ones;
    uint node = is_one ? 0u : (place_in_level - ones) % 4u;
    uvec2 far = far_cluster[is_one ? of_level.x + place_in_level : of_level.y + (place_in_level - ones) / 4u];
    uint other = point_of_node(place_count, far.x, is_one ? 0u : 1u + node);
    real4 place = point[place_of_point(other)];
    real3 u = real3(point[displacement_of_point(other)]), back = real3(0);
#define SEE_NODE(n)                                                                                            \
  {                                                                                                            \
    real4 own = own_point[2 * n];                                                                              \
    real3 x = real3(own) - real3(place);                                                                       \
    real strain = spring_strain(x, real3(own_point[2 * n + 1]) - u), weighed = place.w * strain, by_own = own.w * strain; \
    pull##n = real3(FUSED(weighed, x.x, pull##n.x), FUSED(weighed, x.y, pull##n.y), FUSED(weighed, x.z, pull##n.z)); \
    back = real3(FUSED(by_own, x.x, back.x), FUSED(by_own, x.y, back.y), FUSED(by_own, x.z, back.z));          \
  }
    EACH_OWN(SEE_NODE)
    uint at = far.y + leaf_of_pull(is_one ? 1u : 4u) * of_level.w + 3u * node;
    STORE3(node_pull, at, back)
  }
#define AT(n) (row * 3u * (uint(n) % batch) + THREAD % folded)
#define KEEP(n)                       \
  part[AT(n)] = pull##n.x;            \
  part[AT(n) + row] = pull##n.y;      \
  part[AT(n) + 2u * row] = pull##n.z;
#define TAKE(n)                        \
  part[AT(n)] += pull##n.x;            \
  part[AT(n) + row] += pull##n.y;      \
  part[AT(n) + 2u * row] += pull##n.z;
#define ADD_UP(some, k)                  \
  MEET                                   \
  if (THREAD >= folded) { some(KEEP) }   \
  MEET                                   \
  if (THREAD < folded) { some(TAKE) }    \
  MEET                                   \
  sum_parts(3u * (leaf_size * leaf + k * batch));
  ADD_UP(BATCH_0, 0u)
  ADD_UP(BATCH_1, 1u)
  ADD_UP(BATCH_2, 2u)
  ADD_UP(BATCH_3, 3u)
}
#endif
