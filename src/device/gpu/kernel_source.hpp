// Turns a kernel file into GLSL. The declarations READ, WRITE, SHARED_WRITE, CONSTANTS and PARAMETER become storage blocks,
// uniform blocks and uniforms. Slots follow the order of the flattened source.
#pragma once
#include <span>
#include <string_view>

#include "device/device.hpp"
#include "gl/shader_source.hpp"

namespace pliant::gpu {

struct KernelSource {
  gl::FlatShader shader;
  KernelSignature signature;
};

/// Flattens `frame`, and writes its declarations out. Array k of the signature has binding k, parameter k has location k. Throws
/// Error (device) with file and line if a declaration names no array of physics/arrays.glsl. Throws Error (device) with the file
/// that "@kernel" stands for if there are more than max_arrays.
[[nodiscard]] KernelSource kernel_source(std::span<const gl::ShaderFile> files, std::string_view frame,
                                         std::span<const gl::Define> defines);

}  // namespace pliant::gpu
