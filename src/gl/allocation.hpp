// Taking memory of the GPU, of which there may be too little.
#pragma once

namespace pliant::gl {

/// As long as one lives, debug output, by which any error ends the program, keeps still: running out of memory is no bug. Needs a
/// current Context.
class Allocation {
 public:
  Allocation();
  ~Allocation();
  Allocation(const Allocation&) = delete;
  Allocation& operator=(const Allocation&) = delete;

  /// Whether memory ran out. Any other error is a bug, and ends the program after all.
  [[nodiscard]] bool ran_out() const;
};

}  // namespace pliant::gl
