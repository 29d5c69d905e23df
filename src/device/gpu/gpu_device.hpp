// What drawing needs of the GPU device beyond Device: its context, a window's or its own, and its buffers as OpenGL knows them.
#pragma once
#include <cstdint>
#include <memory>

#include "device/device.hpp"
#include "gl/context.hpp"

namespace pliant {

/// A GPU device in a context that stays current on this thread and outlives the device, such as a window's.
[[nodiscard]] std::unique_ptr<Device> make_gpu_device(gl::Context& context);

}  // namespace pliant

namespace pliant::gpu {

/// Null if `device` is not a GPU device.
[[nodiscard]] gl::Context* context_of(Device& device);

/// The OpenGL name of a GPU device's buffer.
[[nodiscard]] std::uint32_t gl_buffer_of(Device& device, BufferId buffer);

}  // namespace pliant::gpu
