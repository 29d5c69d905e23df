// Where the phases of steps begin in which arrays share memory (state/shared_memory.hpp).
#pragma once
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "device/device.hpp"
#include "state/arrays.hpp"

namespace pliant {

/// Follows passes in the order in which they run.
class SharedPhases {
 public:
  /// Returns whether a phase begins with a pass of this kernel. It does if the kernel names an array that may stand where one
  /// stands that the phase before has named.
  bool begins_with(const KernelSignature& signature) {
    std::set<std::string> named;
    for (const KernelSignature::Array& array : signature.arrays)
      if (shares_memory(array.array)) named.insert(array.array);
    bool begins = false;
    for (const std::string& one : named)
      for (const std::string& other : needed_) begins = begins || may_overlap(one, other);
    if (begins) needed_.clear();
    needed_.merge(named);
    return begins;
  }

 private:
  std::set<std::string> needed_;  // in this phase so far
};

/// Fills all arrays that share memory with this byte.
inline void fill_shared_memory(Arrays& arrays, std::byte value) {
  for (const BufferId buffer : arrays.made_buffers(sharing_arrays()))
    arrays.device().write(buffer, 0, std::vector(arrays.device().size_of(buffer), value));
}

}  // namespace pliant
