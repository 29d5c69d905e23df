// Which device a run takes.
#pragma once
#include <memory>
#include <optional>

#include "device/device.hpp"
#include "gl/context.hpp"

namespace pliant {

enum class DeviceKind { automatic, cpu, gpu };

struct DeviceChoice {
  std::optional<DeviceKind> kind;  // empty: automatic, or what a run had that is resumed
  std::optional<int> gpu_index;    // of gl::list_adapters()
  std::optional<int> precision;    // of the forces [bits]; empty: 32
  unsigned threads = 0;            // 0: one a processor
};

[[nodiscard]] bool has_hardware_gpu();

/// Throws Error (command_line) for a contradiction.
void expect_consistent(const DeviceChoice& choice);

/// Automatic: a hardware GPU if there is one and precision is 32, else the CPU; software OpenGL only when the GPU is asked for.
/// Throws Error: command_line for a contradiction, device when there is no such device.
[[nodiscard]] std::unique_ptr<Device> choose_device(const DeviceChoice& choice);
/// The same, where the only GPU is that of a window.
[[nodiscard]] std::unique_ptr<Device> choose_device(const DeviceChoice& choice, gl::Context& window);

}  // namespace pliant
