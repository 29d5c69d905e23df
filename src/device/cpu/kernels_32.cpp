// The kernels with forces in fp32.
#define REAL_BITS 32
#include "device/cpu/kernels.inc"

std::span<const pliant::cpu::KernelEntry> pliant::cpu::kernels_32() { return physics32::entries; }

void pliant::cpu::sum_plainly_32(const ShareTask& task, glm::dvec3* sums, std::uint32_t first, std::uint32_t end) {
  physics32::sum_plainly(task, sums, first, end);
}
