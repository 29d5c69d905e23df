// What drawing needs of the GPU device beyond Device: its context and its buffers as OpenGL knows them.
#pragma once
#include <cstdint>

#include "device/device.hpp"
#include "gl/context.hpp"

namespace pliant::gpu {

/// Null if `device` is not a GPU device.
[[nodiscard]] gl::Context* context_of(Device& device);

/// The OpenGL name of a GPU device's buffer.
[[nodiscard]] std::uint32_t gl_buffer_of(Device& device, BufferId buffer);

}  // namespace pliant::gpu
