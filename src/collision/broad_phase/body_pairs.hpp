// Finds which bodies may touch: pairs of bodies whose boxes overlap. All later collision work is only for these.
#pragma once
#include "device/pass.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

class BodyPairs {
 public:
  /// `bodies` must outlive this. Expects at most 65,535 bodies, because pairs are counted in 32 bits.
  explicit BodyPairs(DeviceBodies& bodies);

  /// Returns how many near pairs there can be, at least 1.
  [[nodiscard]] std::uint32_t most_pairs() const { return most_pairs_; }
  /// Bounds every body at `half`. A step does that itself as it ends.
  [[nodiscard]] Pass bounding_pass(std::uint32_t half) const;
  /// Lists the near pairs of the bodies' present boxes. Expects the trees' roots (TreeSearch).
  [[nodiscard]] Pass pairing_pass() const;

 private:
  DeviceBodies& bodies_;
  std::uint32_t most_pairs_;
};

}  // namespace pliant
