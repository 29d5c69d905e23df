#include "device/cpu/leaf_springs.hpp"

#include <algorithm>

#include "core/expect.hpp"
#include "physics/forces/clusters.glsl"

namespace pliant::cpu {

static_assert(leaf_lanes == physics::leaf_size && points_of_cluster == physics::nodes_of_cluster);
static_assert(pull_row == physics::pull_row_size);

template <class Real>
ClusterFunctions<Real> cluster_functions(Isa isa) {
  PLIANT_EXPECT(std::ranges::find(available_isas(), isa) != available_isas().end());
#ifdef PLIANT_X86_TILES
  if (isa == Isa::avx512) return cluster_functions_avx512<Real>();
  if (isa == Isa::avx2) return cluster_functions_avx2<Real>();
#endif
  return cluster_functions_portable<Real>();
}

template ClusterFunctions<float> cluster_functions(Isa isa);
template ClusterFunctions<double> cluster_functions(Isa isa);

}  // namespace pliant::cpu
