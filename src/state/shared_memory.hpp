// Arrays that are needed in different phases of a step stand in the same memory. The list in shared_memory.cpp says which do.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "device/device.hpp"

namespace pliant {

/// Whether an array shares memory with others. When a phase begins that needs it, it may hold anything.
[[nodiscard]] bool shares_memory(std::string_view array);
/// Whether two arrays may stand in the same memory: no phase needs both.
[[nodiscard]] bool may_overlap(std::string_view a, std::string_view b);
/// Throws std::logic_error, which names them, if two arrays of a kernel may stand in the same memory.
void expect_apart(std::span<const KernelSignature::Array> arrays);
/// The names of all arrays that share memory.
[[nodiscard]] std::vector<std::string_view> sharing_arrays();

/// One buffer. If each array is placed once, it is as large as the phase that needs the most.
class SharedMemory {
 public:
  /// `device` must outlive it.
  explicit SharedMemory(Device& device) : device_(device) {}
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// Returns a part of the buffer, of which no array has a byte that a phase needs together with this one. An earlier place of
  /// the array is free again. What all arrays hold may be lost.
  [[nodiscard]] BufferId place(std::string_view array, std::size_t bytes);

 private:
  struct Place {
    std::string array;
    std::size_t first_byte, end;
  };

  Device& device_;
  BufferId buffer_ = 0;
  std::vector<Place> places_;
};

}  // namespace pliant
