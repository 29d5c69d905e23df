// Tests of triangles in vectors of 64 bytes.
#if defined(__AVX512F__)
#include "device/cpu/triangle_lanes.hpp"
#include "device/cpu/triangle_lanes.inc"

pliant::cpu::LaneAnswers pliant::cpu::test_lanes_avx512(const TriangleLanes& pairs, unsigned count) {
  return VectorTest<16>::test_first(pairs, count);
}
#endif
