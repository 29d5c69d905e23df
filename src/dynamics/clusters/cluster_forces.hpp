// Records the passes that sum the springs of clustered bodies on a device.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "device/pass.hpp"
#include "model/model.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

class ClusterForces {
 public:
  /// Makes the arrays. `accuracies` has one for each body that is clustered (cluster_pairs.hpp). `bodies` must outlive this.
  ClusterForces(DeviceBodies& bodies, const Model& model, std::span<const std::optional<double>> accuracies);

  /// Returns passes that set `spring_sum` at the placements in a slot, for clustered bodies that move and are deformed. With
  /// `only_stale` they leave out bodies whose kept forces still hold. Sums of all others are undefined.
  [[nodiscard]] std::vector<Pass> passes(std::uint32_t slot, bool only_stale) const;

  /// Returns how many springs a sum of this body's has. 0: it is not clustered.
  [[nodiscard]] std::uint64_t springs_of(std::size_t body) const { return springs_of_bodies_[body]; }

 private:
  const DeviceBodies& bodies_;
  std::vector<std::uint64_t> springs_of_bodies_;
  std::uint32_t leaf_count_ = 0, cluster_count_ = 0;
};

}  // namespace pliant
