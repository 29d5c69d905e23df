// Spring forces in vectors of 64 bytes.
#if defined(__AVX512F__)
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
  typedef float Lanes __attribute__((vector_size(64)));
  typedef int Bits __attribute__((vector_size(64)));
};
template <>
struct Vectors<double> {
  typedef double Lanes __attribute__((vector_size(64)));
  typedef long long Bits __attribute__((vector_size(64)));
};

// Returns a quarter of the strain, growth / (now + sqrt(now rest)), as spring_tile.inc does.
// With P = now rest / 4, let y be 1 / sqrt(P) to 14 bits. Then e = 1 - P y^2 is small, and
//   sqrt(now rest) = 2 P y (1 + e / 2 + 3 e^2 / 8 + 5 e^3 / 16 + ...).
// fp32 needs no more than e / 2. The divider works beside the multipliers, so a division costs less than refining a guess.
// max() is for rests that rounding has taken to zero or below, where a spring is stretched a thousand times. It lets NaN through.
#define PLIANT_HAS_QUARTER_STRAIN
template <class Real>
PLIANT_INLINE __m512 quarter_strain(__m512 growth, __m512 now) {
  const __m512 product = _mm512_max_ps(_mm512_set1_ps(1e-35f), now * (now * 0.25f - growth));
  const __m512 guess = _mm512_rsqrt14_ps(product);
  const __m512 root = product * guess;
  return growth / (now + root * (3.0f - root * guess));
}
template <class Real>
PLIANT_INLINE __m512d quarter_strain(__m512d growth, __m512d now) {
  const __m512d product = _mm512_max_pd(_mm512_set1_pd(1e-100), now * (now * 0.25 - growth));
  const __m512d guess = _mm512_rsqrt14_pd(product);
  const __m512d root = product * guess;
  const __m512d e = 1.0 - root * guess;
  return growth / (now + root * (2.0 + e * (1.0 + e * (0.75 + e * 0.625))));
}

}  // namespace

#include "device/cpu/leaf_springs.inc"

void sum_tile_avx512(const SpringTile<float>& tile) { sum_tile(tile); }
void sum_tile_avx512(const SpringTile<double>& tile) { sum_tile(tile); }
template <>
ClusterFunctions<float> cluster_functions_avx512() {
  return functions_of_clusters<float>;
}
template <>
ClusterFunctions<double> cluster_functions_avx512() {
  return functions_of_clusters<double>;
}

}  // namespace pliant::cpu
#endif
