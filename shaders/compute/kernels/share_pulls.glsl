// A group kernel. It adds to what the vertices of a tile of leaves get what their clusters' nodes get. It runs behind sum_node_pulls, and
// before a stage.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
#include "../physics/layout.glsl"
READ(body)
READ(status)
READ(rest_position)
READ(spring_cluster)
READ(spring_leaf)
READ(above_cluster)
READ(tree_vertex)
READ(leaf_pull)
READ(cluster_pull)
WRITE(spring_sum)
#include "parts/sums_leaf.glsl"
NEAR(double, all, moments_size * leaves_of_tile)  // [leaf][12]: what clusters above hand down

void share_out(uint leaf, uint place, uint at) {
  uint i = tree_vertex[place];
  dvec3 rest = dvec3(rest_position[i]) * body[spring_leaf[leaf].x].inverse_unit;
  dvec3 pull = LOAD3(leaf_pull, 3u * place) + LOAD3(all, at) + rest.x * LOAD3(all, at + 3u) + rest.y * LOAD3(all, at + 6u) +
               rest.z * LOAD3(all, at + 9u);
  STORE3(spring_sum, force_of(i), pull)
}

void share_pulls(uint tile) {
  for (uint k = THREAD; k < leaves_of_tile * moments_size; k += THREADS) {
    uint leaf = first_leaf + leaves_of_tile * tile + k / moments_size;
    double sum = double(0);
    if (sums_leaf(leaf))
      for (uint j = spring_leaf[leaf].w; j < spring_leaf[leaf + 1u].w; ++j)
        sum += cluster_pull[moments_size * above_cluster[j] + k % moments_size];
    all[k] = sum;
  }
  MEET
  for (uint k = THREAD; k < places_of_tile; k += THREADS) {
    uint leaf = first_leaf + leaves_of_tile * tile + k / leaf_size;
    if (sums_leaf(leaf) && k % leaf_size < spring_cluster[spring_leaf[leaf].y].vertex_count)
      share_out(leaf, leaf_size * leaf + k % leaf_size, moments_size * (k / leaf_size));
  }
}
