#include "device/cpu/leaf_springs.hpp"

#include <algorithm>

#include "core/expect.hpp"
#include "physics/forces/clusters.glsl"

namespace pliant::cpu {

static_assert(leaf_lanes == physics::leaf_size);

template <class Real>
LeafFunction<Real> leaf_function(Isa isa) {
  PLIANT_EXPECT(std::ranges::find(available_isas(), isa) != available_isas().end());
#ifdef PLIANT_X86_TILES
  if (isa == Isa::avx512) return &sum_leaf_avx512;
  if (isa == Isa::avx2) return &sum_leaf_avx2;
#endif
  return &sum_leaf_portable;
}

template LeafFunction<float> leaf_function(Isa isa);
template LeafFunction<double> leaf_function(Isa isa);

}  // namespace pliant::cpu
