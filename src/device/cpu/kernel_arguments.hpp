// The arguments of a kernel on the CPU.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "core/thread_pool.hpp"
#include "device/device.hpp"

namespace pliant::cpu {

struct KernelArguments {
  void* const* buffers = nullptr;         // in the order in which the kernel declares them
  const Parameter* parameters = nullptr;  // in the same order
  KernelSignature* declared = nullptr;    // if not null, the kernel only says what it declares
  bool works_alone = false;               // one thread runs all items
};

/// Hands a kernel its arguments one after another, as its members ask for them.
class ArgumentReader {
 public:
  explicit ArgumentReader(const KernelArguments& arguments) : arguments_(arguments) {}

  [[nodiscard]] bool works_alone() const { return arguments_.works_alone; }
  template <class T>
  [[nodiscard]] const T* read(std::string_view array, std::string_view view = {}) {
    return static_cast<const T*>(next_buffer(array, ArrayUse::read, view));
  }
  template <class T>
  [[nodiscard]] T* write(std::string_view array, std::string_view view = {}) {
    return static_cast<T*>(next_buffer(array, ArrayUse::write, view));
  }
  template <class T>
  [[nodiscard]] const T* constants(std::string_view array) {
    return static_cast<const T*>(next_buffer(array, ArrayUse::constants, {}));
  }
  template <class T>
  [[nodiscard]] T parameter(std::string_view name) {
    if (arguments_.declared == nullptr) return std::get<T>(arguments_.parameters[parameter_++]);
    arguments_.declared->parameters.push_back({std::string(name), std::is_same_v<T, double>});
    return {};
  }

 private:
  void* next_buffer(std::string_view array, ArrayUse use, std::string_view view) {
    if (arguments_.declared == nullptr) return arguments_.buffers[buffer_++];
    arguments_.declared->arrays.push_back({std::string(array), std::string(array), use, std::string(view)});
    return nullptr;
  }

  const KernelArguments& arguments_;
  std::size_t buffer_ = 0, parameter_ = 0;
};

/// Runs a thread's items.
using KernelFunction = void (*)(const KernelArguments& arguments, ThreadPool::Ranges& items);

/// What a force kernel asks to be summed for one of its shares.
struct ShareTask {
  bool runs = false;      // else the share is left out
  bool deformed = false;  // else the sums are zero
  std::uint32_t first_vertex = 0, vertex_count = 0;
  std::uint32_t first_in_body = 0, body_vertices = 0;  // where the share begins in its body, and how many vertices that has
  const void* positions = nullptr;                     // real4 [vertex] of the share's body, from its first vertex on
  const void* displacements = nullptr;                 // the same of displacements
  const double* given_sums = nullptr;                  // the array `spring_sum`
};

inline constexpr std::uint32_t longest_range = 64;  // most vertices that a force kernel finishes at once

/// A force kernel in two parts. `task` says what a share needs summed. `finish` then finishes vertices first to end - 1 of the
/// share. `sums` holds for each vertex of the share the sum over its springs of strain times length [units].
struct ForceFunctions {
  ShareTask (*task)(const KernelArguments& arguments, std::uint32_t share) = nullptr;
  void (*finish)(const KernelArguments& arguments, std::uint32_t share, const glm::dvec3* sums, std::uint32_t first,
                 std::uint32_t end) = nullptr;
};

/// A kernel that goes in rounds, up to `most`. Its items are counted before the first round, and it may end after any.
struct RoundFunctions {
  std::uint32_t (*items)(const KernelArguments& arguments) = nullptr;
  std::uint32_t (*most)(const KernelArguments& arguments) = nullptr;
  bool (*goes_on)(const KernelArguments& arguments, std::uint32_t round) = nullptr;
  void (*run)(const KernelArguments& arguments, std::uint32_t round, ThreadPool::Ranges& items) = nullptr;
};

struct KernelEntry {
  std::string_view name;
  KernelSignature (*signature)();
  KernelFunction function;  // null for a force kernel and for one in rounds
  ForceFunctions force;     // what a force kernel has instead
  RoundFunctions rounds;    // what a kernel in rounds has instead
  /// Items that one of several threads takes at a time: a microsecond's, or 1 where few have work. Where there are many items,
  /// ranges are up to 8 times as long, but a length of 1 stays 1.
  std::uint32_t grain;
};

/// Sums the springs of the share's vertices first to end - 1, one by one. Faster ways are compared with it.
using PlainSum = void (*)(const ShareTask& task, glm::dvec3* sums, std::uint32_t first, std::uint32_t end);
void sum_plainly_32(const ShareTask& task, glm::dvec3* sums, std::uint32_t first, std::uint32_t end);
void sum_plainly_64(const ShareTask& task, glm::dvec3* sums, std::uint32_t first, std::uint32_t end);

[[nodiscard]] std::span<const KernelEntry> kernels_32();
[[nodiscard]] std::span<const KernelEntry> kernels_64();

}  // namespace pliant::cpu
