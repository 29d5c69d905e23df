#define REAL_BITS 64
#include "support/own_kernels.inc"

std::span<const pliant::cpu::KernelEntry> own_kernels_64() { return pliant::physics64::own_entries; }
std::span<const pliant::cpu::KernelEntry> misread_kernel_64() { return pliant::physics64::misread_entries; }
