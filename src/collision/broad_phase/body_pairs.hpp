// Which bodies may touch: pairs of bodies whose boxes overlap. All later collision work is for these alone.
#pragma once
#include "device/pass.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

class BodyPairs {
 public:
  /// `bodies` must outlive this.
  explicit BodyPairs(DeviceBodies& bodies);

  /// At least 1.
  [[nodiscard]] std::uint32_t most_pairs() const { return most_pairs_; }
  /// Bounds every body at `half`. A step does that itself as it ends.
  [[nodiscard]] Pass bounding_pass(std::uint32_t half) const;
  /// Lists the near pairs, as the bodies' boxes stand. Expects the trees' roots (TreeSearch).
  [[nodiscard]] Pass pairing_pass() const;

 private:
  DeviceBodies& bodies_;
  std::uint32_t most_pairs_;
};

}  // namespace pliant
