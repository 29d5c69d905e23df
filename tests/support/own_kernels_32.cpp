#define REAL_BITS 32
#include "support/own_kernels.inc"

std::span<const pliant::cpu::KernelEntry> own_kernels_32() { return pliant::physics32::own_entries; }
std::span<const pliant::cpu::KernelEntry> misread_kernel_32() { return pliant::physics32::misread_entries; }
