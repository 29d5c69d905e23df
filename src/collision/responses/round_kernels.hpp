// Kernels that go in rounds (shaders/compute/rounds.comp). Their work groups wait for each other, so all of them have to run at
// once.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "device/pass.hpp"
#include "state/arrays.hpp"

namespace pliant {

class RoundKernels {
 public:
  /// `arrays` must outlive this. A pass has `most_groups` work groups, or one if that is 0. Sets the parameter `is_rehearsal`.
  RoundKernels(Arrays& arrays, std::uint32_t most_groups);

  /// Returns a pass of work groups that the device runs at once. How many those are depends on the kernel's memory. So the first
  /// call for a kernel lets groups wait for each other, and halves their number until all meet. It needs all arrays of the
  /// kernel, and leaves them as they are. Throws Error (device) if the kernel does not build.
  [[nodiscard]] Pass pass(std::string_view name, const Parameters& parameters) const;

 private:
  [[nodiscard]] Pass pass_of(std::string_view name, const Parameters& parameters, std::uint32_t groups) const;
  [[nodiscard]] bool all_meet(std::string_view name, Parameters parameters, std::uint32_t groups) const;

  Arrays& arrays_;
  std::uint32_t most_groups_;
  mutable std::map<std::string, std::uint32_t, std::less<>> groups_of_;  // as found out so far
};

}  // namespace pliant
