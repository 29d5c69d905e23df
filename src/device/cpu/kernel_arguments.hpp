// What a kernel on the CPU is called with.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "device/device.hpp"

namespace pliant::cpu {

struct KernelArguments {
  std::array<void*, max_buffers> buffers{};
  const std::array<Parameter, max_parameters>* parameters = nullptr;

  template <class T>
  [[nodiscard]] const T* read(int slot) const {
    return static_cast<const T*>(buffers[static_cast<std::size_t>(slot)]);
  }
  template <class T>
  [[nodiscard]] T* write(int slot) const {
    return static_cast<T*>(buffers[static_cast<std::size_t>(slot)]);
  }
  template <class T>
  [[nodiscard]] T parameter(int slot) const {
    return std::get<T>((*parameters)[static_cast<std::size_t>(slot)]);
  }
};

/// Runs items first to end - 1.
using KernelFunction = void (*)(const KernelArguments& arguments, std::uint32_t first, std::uint32_t end);

struct KernelEntry {
  std::string_view name;
  KernelFunction function;
};

[[nodiscard]] std::span<const KernelEntry> kernels_32();
[[nodiscard]] std::span<const KernelEntry> kernels_64();

}  // namespace pliant::cpu
