// The kernels with forces in fp64.
#define REAL_BITS 64
#include "device/cpu/kernels.inc"

std::span<const pliant::cpu::KernelEntry> pliant::cpu::kernels_64() { return physics64::entries; }
