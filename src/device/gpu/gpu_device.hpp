// Gives drawing what Device does not: the GPU device's context, which is a window's or its own, and its buffers as OpenGL knows
// them. Gives tests a device that takes items in another order.
#pragma once
#include <cstdint>
#include <memory>

#include "device/device.hpp"
#include "gl/context.hpp"

namespace pliant {

/// Makes a GPU device in a context, such as a window's. The context must stay current on this thread and outlive the device.
[[nodiscard]] std::unique_ptr<Device> make_gpu_device(gl::Context& context);

/// In which order the items of a kernel are given to threads, and the threads of a group work. No result may depend on it. Force
/// kernels have an order of their own.
enum class ItemOrder { ascending, descending };

/// Makes one as make_gpu_device(index) does, with this order.
[[nodiscard]] std::unique_ptr<Device> make_gpu_device(int index, ItemOrder order);

}  // namespace pliant

namespace pliant::gpu {

/// Returns null if `device` is not a GPU device.
[[nodiscard]] gl::Context* context_of(Device& device);

/// Returns the OpenGL name of a GPU device's buffer.
[[nodiscard]] std::uint32_t gl_buffer_of(Device& device, BufferId buffer);

/// Throws Error (device) if a GPU with so much free memory has no room for `bytes` beside what is allocated. NVIDIA's driver
/// would take the processor's memory then, which is some hundred times slower. Allows all if `free_memory` is 0. All in bytes.
void expect_room(std::uint64_t bytes, std::uint64_t allocated, std::uint64_t free_memory);

}  // namespace pliant::gpu
