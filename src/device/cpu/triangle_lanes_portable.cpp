// Tests of triangles in vectors of 16 bytes, which every processor has or the compiler takes apart.
#include "device/cpu/triangle_lanes.hpp"
#include "device/cpu/triangle_lanes.inc"

pliant::cpu::LaneAnswers pliant::cpu::test_lanes_portable(const TriangleLanes& pairs, unsigned count) {
  return VectorTest<4>::test_first(pairs, count);
}
