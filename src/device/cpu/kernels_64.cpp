// The kernels with forces in fp64.
#define REAL_BITS 64
#include "device/cpu/kernels.inc"

std::span<const pliant::cpu::KernelEntry> pliant::cpu::kernels_64() { return physics64::entries; }

void pliant::cpu::sum_plainly_64(const ShareTask& task, glm::dvec3* sums, std::uint32_t first, std::uint32_t end) {
  physics64::sum_plainly(task, sums, first, end);
}
