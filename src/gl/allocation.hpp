// Takes memory of the GPU, which may have too little.
#pragma once

namespace pliant::gl {

/// Keeps debug output off as long as it lives. Debug output ends the program on any error, but running out of memory is not a
/// bug. Needs a current Context.
class Allocation {
 public:
  Allocation();
  ~Allocation();
  Allocation(const Allocation&) = delete;
  Allocation& operator=(const Allocation&) = delete;

  /// Returns whether memory ran out. Any other error is a bug and ends the program after all.
  [[nodiscard]] bool ran_out() const;
};

}  // namespace pliant::gl
