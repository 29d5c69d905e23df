// How many steps to make between two looks at interrupts and the clock.
#pragma once
#include <algorithm>
#include <cstdint>

namespace pliant {

/// Grows while batches are short, because a look after each step would cost more than small steps.
class Batch {
 public:
  static constexpr double time = 0.1;  // that a batch should take [s]

  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  /// Tells it how long so many steps, or fewer, took [s].
  void took(double seconds) { steps_ = seconds < time ? std::min(2 * steps_, most) : std::max<std::uint64_t>(steps_ / 2, 1); }

 private:
  static constexpr std::uint64_t most = 1024;
  std::uint64_t steps_ = 1;
};

}  // namespace pliant
