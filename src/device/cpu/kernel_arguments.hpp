// What a kernel on the CPU is called with.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
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

/// What a force kernel asks to be summed for one of its shares.
struct ShareTask {
  bool runs = false;      // else the share is left out
  bool deformed = false;  // else the sums are zero
  std::uint32_t first_vertex = 0, vertex_count = 0;
  const void* positions = nullptr;      // real4 [vertex] of the share's body, from its first vertex on
  const void* displacements = nullptr;  // likewise
};

inline constexpr std::uint32_t longest_range = 64;  // of vertices that a force kernel finishes at once

/// A force kernel: first says what it needs summed, then finishes vertices first to end - 1 of a share with the sums over their
/// springs of strain times length [units], one a vertex of the share.
struct ForceFunctions {
  ShareTask (*task)(const KernelArguments& arguments, std::uint32_t share) = nullptr;
  void (*finish)(const KernelArguments& arguments, std::uint32_t share, const glm::dvec3* sums, std::uint32_t first,
                 std::uint32_t end) = nullptr;
};

struct KernelEntry {
  std::string_view name;
  KernelFunction function;  // null for a force kernel, which has
  ForceFunctions force;     // these instead
  std::uint32_t grain;      // items that a thread takes at a time: some microseconds' work, more than it costs to wake one up
};

/// Sums the springs of the share's vertices first to end - 1, one by one: the reference for faster ways.
using PlainSum = void (*)(const ShareTask& task, glm::dvec3* sums, std::uint32_t first, std::uint32_t end);
void sum_plainly_32(const ShareTask& task, glm::dvec3* sums, std::uint32_t first, std::uint32_t end);
void sum_plainly_64(const ShareTask& task, glm::dvec3* sums, std::uint32_t first, std::uint32_t end);

[[nodiscard]] std::span<const KernelEntry> kernels_32();
[[nodiscard]] std::span<const KernelEntry> kernels_64();

}  // namespace pliant::cpu
