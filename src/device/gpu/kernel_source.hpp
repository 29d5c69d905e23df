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

/// Returns the binding of one of a signature's arrays. Arrays of constants have theirs behind those of all others.
[[nodiscard]] std::size_t binding_of(std::span<const KernelSignature::Array> arrays, std::size_t place);

/// Flattens `frame`, and writes its declarations out. Parameter k has location k. Throws Error (device) with file and line if a
/// declaration names no array of physics/arrays.glsl. Throws Error (device) with the file that "@kernel" stands for if there are
/// more than max_arrays or max_constants.
[[nodiscard]] KernelSource kernel_source(std::span<const gl::ShaderFile> files, std::string_view frame,
                                         std::span<const gl::Define> defines);

}  // namespace pliant::gpu
