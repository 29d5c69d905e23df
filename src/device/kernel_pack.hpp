// Lets another program add kernels to those of the library.
#pragma once
#include <span>

#include "device/cpu/kernel_arguments.hpp"
#include "gl/shader_source.hpp"

namespace pliant {

/// The same kernels twice: for GPUs as files named "compute/kernels/NAME.glsl", and compiled for CPUs
/// (device/cpu/kernel_prelude.inc). What is viewed must outlive every device.
struct KernelPack {
  std::span<const gl::ShaderFile> files;
  std::span<const cpu::KernelEntry> on_cpu_32, on_cpu_64;
};

/// Adds kernels to the devices that are made from then on.
void add_kernels(const KernelPack& pack);

/// Return the library's and all that were added.
[[nodiscard]] std::vector<gl::ShaderFile> all_shader_files();
[[nodiscard]] std::vector<cpu::KernelEntry> all_kernels_on_cpu(int precision);

}  // namespace pliant
