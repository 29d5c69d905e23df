// Tests of triangles in vectors of 32 bytes.
#if defined(__AVX2__)
#include "device/cpu/triangle_lanes.hpp"
#include "device/cpu/triangle_lanes.inc"

pliant::cpu::LaneAnswers pliant::cpu::test_lanes_avx2(const TriangleLanes& pairs, unsigned count) {
  return VectorTest<8>::test_first(pairs, count);
}
#endif
