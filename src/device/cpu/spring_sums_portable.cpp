// Spring forces in vectors of 16 bytes, which every processor has or the compiler takes apart.
#include <cstddef>
#include <utility>

#include "device/cpu/leaf_springs.hpp"
#include "device/cpu/spring_tile.hpp"

#define PLIANT_INLINE inline __attribute__((always_inline))

namespace pliant::cpu {
namespace {

template <class Real>
struct Vectors;
template <>
struct Vectors<float> {
  typedef float Lanes __attribute__((vector_size(16)));
  typedef int Bits __attribute__((vector_size(16)));
};
template <>
struct Vectors<double> {
  typedef double Lanes __attribute__((vector_size(16)));
  typedef long long Bits __attribute__((vector_size(16)));
};

template <class V>
PLIANT_INLINE V square_root(V v) {
  for (unsigned lane = 0; lane < sizeof(V) / sizeof(v[0]); ++lane)
    if constexpr (sizeof(v[0]) == sizeof(float))
      v[lane] = __builtin_sqrtf(v[lane]);
    else
      v[lane] = __builtin_sqrt(v[lane]);
  return v;
}

}  // namespace

#include "device/cpu/leaf_springs.inc"

void sum_tile_portable(const SpringTile<float>& tile) { sum_tile(tile); }
void sum_tile_portable(const SpringTile<double>& tile) { sum_tile(tile); }
template <>
ClusterFunctions<float> cluster_functions_portable() {
  return functions_of_clusters<float>;
}
template <>
ClusterFunctions<double> cluster_functions_portable() {
  return functions_of_clusters<double>;
}

}  // namespace pliant::cpu
