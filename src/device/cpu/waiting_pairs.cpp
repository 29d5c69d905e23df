#include "device/cpu/waiting_pairs.hpp"

#include <algorithm>

#include "core/expect.hpp"

pliant::cpu::LaneTest pliant::cpu::lane_test(Isa isa) {
  PLIANT_EXPECT(std::ranges::find(available_isas(), isa) != available_isas().end());
#ifdef PLIANT_X86_TILES
  if (isa == Isa::avx512) return &test_lanes_avx512;
  if (isa == Isa::avx2) return &test_lanes_avx2;
#endif
  return &test_lanes_portable;
}
