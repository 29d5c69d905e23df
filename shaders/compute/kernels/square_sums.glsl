// One thread takes a leaf, and squares what its vertices get. So a run can tell how large the errors of clusters are. Of a leaf of samples
// all springs have been summed, in parts_of_sample parts. The first part is served for all. It runs behind share_pulls.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
#include "../physics/layout.glsl"
READ(status)
READ(spring_cluster)
READ(spring_leaf)
READ(tree_vertex)
READ(leaf_pull)
READ(spring_sum)
WRITE(leaf_square)
PARAMETER(uint, first_sample)  // leaf
#include "parts/sums_leaf.glsl"

void square_sums(uint leaf) {
  dvec3 squares = dvec3(0);
  bool is_sample = leaf >= first_sample, is_served = !is_sample || (leaf - first_sample) % parts_of_sample == 0u;
  uint parts = is_sample ? parts_of_sample : 1u, count = 0u;
  if (is_served && sums_leaf(leaf)) count = spring_cluster[spring_leaf[leaf].y].vertex_count;
  for (uint k = 0u; k < count; ++k) {
    dvec3 pull = dvec3(0), sum = LOAD3(spring_sum, force_of(tree_vertex[leaf_size * leaf + k]));
    double size = double(0);
    for (uint part = 0u; part < parts; ++part) {
      dvec3 of_part = LOAD3(leaf_pull, 3u * (leaf_size * (leaf + part) + k));
      pull += of_part;
      size += length(of_part);
    }
    squares += dvec3(dot(sum - pull, sum - pull), dot(sum, sum), size * size);
  }
  STORE3(leaf_square, 3u * leaf, squares)
}
