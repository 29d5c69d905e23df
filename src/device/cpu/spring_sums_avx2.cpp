// Spring forces in vectors of 32 bytes.
#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>

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
  typedef float Lanes __attribute__((vector_size(32)));
  typedef int Bits __attribute__((vector_size(32)));
};
template <>
struct Vectors<double> {
  typedef double Lanes __attribute__((vector_size(32)));
  typedef long long Bits __attribute__((vector_size(32)));
};

PLIANT_INLINE __m256 square_root(__m256 v) { return _mm256_sqrt_ps(v); }
PLIANT_INLINE __m256d square_root(__m256d v) { return _mm256_sqrt_pd(v); }

}  // namespace

#include "device/cpu/leaf_springs.inc"

void sum_tile_avx2(const SpringTile<float>& tile) { sum_tile(tile); }
void sum_tile_avx2(const SpringTile<double>& tile) { sum_tile(tile); }
template <>
ClusterFunctions<float> cluster_functions_avx2() {
  return functions_of_clusters<float>;
}
template <>
ClusterFunctions<double> cluster_functions_avx2() {
  return functions_of_clusters<double>;
}

}  // namespace pliant::cpu
#endif
