// One thread adds to what the vertices of a leaf get what their clusters' nodes get. It runs behind sum_node_pulls, and before a stage.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
#include "../physics/layout.glsl"
READ(body)
READ(status)
READ(rest_position)
READ(spring_cluster)
READ(spring_leaf)
READ(tree_vertex)
READ(leaf_pull)
READ(cluster_pull)
WRITE(spring_sum)
#include "parts/sums_clusters.glsl"

void share_pulls(uint leaf) {
  uvec4 own = spring_leaf[leaf];
  if (!sums_clusters(own.x)) return;
  double inverse_unit = body[own.x].inverse_unit;
  dvec3 centre = LOAD3(spring_cluster[own.y].centre, 0u);
  dvec3 sum = dvec3(0), x_sum = dvec3(0), y_sum = dvec3(0), z_sum = dvec3(0);
  for (uint c = own.y; c != no_cluster; c = spring_cluster[c].parent) {
    if (spring_cluster[c].first_partner == spring_cluster[c].end_partner) continue;
    dvec3 way = (centre - LOAD3(spring_cluster[c].centre, 0u)) * inverse_unit;
    uint at = moments_size * c;
    dvec3 x_pull = LOAD3(cluster_pull, at + 3u), y_pull = LOAD3(cluster_pull, at + 6u), z_pull = LOAD3(cluster_pull, at + 9u);
    sum += LOAD3(cluster_pull, at) + way.x * x_pull + way.y * y_pull + way.z * z_pull;
    x_sum += x_pull;
    y_sum += y_pull;
    z_sum += z_pull;
  }
  for (uint k = 0u; k < own.w; ++k) {
    uint place = leaf_size * leaf + k, i = tree_vertex[place];
    dvec3 arm = (dvec3(rest_position[i]) - centre) * inverse_unit;
    dvec3 pull = LOAD3(leaf_pull, 3u * place) + sum + arm.x * x_sum + arm.y * y_sum + arm.z * z_sum;
    STORE3(spring_sum, force_of(i), pull)
  }
}
