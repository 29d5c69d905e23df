// The kernels with forces in fp32.
#define REAL_BITS 32
#include "device/cpu/kernels.inc"

std::span<const pliant::cpu::KernelEntry> pliant::cpu::kernels_32() { return physics32::entries; }
