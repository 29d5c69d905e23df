// Finds which bodies may touch: pairs of bodies whose boxes overlap. All later collision work is only for these.
#pragma once
#include <vector>

#include "device/pass.hpp"
#include "model/model.hpp"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

class BodyPairs {
 public:
  /// `bodies` must outlive this. Expects at most 65,535 bodies, because pairs are counted in 32 bits.
  BodyPairs(DeviceBodies& bodies, const Model& model, BroadPhase broad_phase);

  /// Returns how many near pairs the list holds, at least 1: all, or 64 for each body.
  [[nodiscard]] std::uint32_t most_pairs() const { return most_pairs_; }
  /// Bounds every body at `half`. A step does that itself as it ends.
  [[nodiscard]] Pass bounding_pass(std::uint32_t half) const;
  /// List the near pairs of the bodies' present boxes. Expect the trees' roots (TreeSearch).
  [[nodiscard]] std::vector<Pass> pairing_passes() const;
  /// Bound the step by bodies that may reach each other in it. Expect the arrays of contact by impulses.
  [[nodiscard]] std::vector<Pass> limiting_passes() const;
  /// Returns how many pairs of bodies there are that might touch.
  [[nodiscard]] std::uint32_t pair_count() const { return pair_count_; }

 private:
  [[nodiscard]] std::vector<Pass> passes_over_pairs(std::string_view entering, Pass visiting) const;
  [[nodiscard]] std::uint32_t visiting_threads() const;

  DeviceBodies& bodies_;
  std::uint32_t pair_count_, most_pairs_, grid_lists_, threads_of_body_;
};

}  // namespace pliant
