// Which force kernels serve which bodies, and which of these share a dispatch.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "device/force_variant.hpp"

namespace pliant {

/// The shares of the bodies that one variant of the force kernels serves.
struct ForceGroup {
  std::size_t variant;  // as Device::force_kernel has it
  std::uint32_t first_share, share_count;
  bool all_stages;        // whether one dispatch can run all stages of a step
  bool has_whole_bodies;  // whether each body is one share
  bool quiet_steps;       // whether one dispatch can run quiet steps of the bodies that move from the start
};

/// What the choice has to know of a body.
struct ForceBody {
  std::uint32_t vertex_count;
  bool is_soft;                 // others have no shares
  bool moves;                   // from the start, whatever touches it later
  bool has_given_sums = false;  // whether other passes sum its springs
};

/// What the choice has to know of a device.
struct ForceAbilities {
  std::span<const ForceVariant> variants;
  std::uint32_t shares_at_once;      // Device::shares_at_once()
  ForceVariant for_given_sums = {};  // Device::variant_for_given_sums()

  /// `place` is as Device::force_kernel has it.
  [[nodiscard]] const ForceVariant& variant(std::size_t place) const {
    return place == variants.size() ? for_given_sums : variants[place];
  }
};

/// Returns the groups of bodies that have these variants, in the order of variants.
[[nodiscard]] std::vector<ForceGroup> group_shares(const ForceAbilities& device, std::span<const ForceBody> bodies,
                                                   std::span<const std::size_t> variants_of_bodies);

/// Chooses a variant for each body. If sums of one are given, each of the others has the fastest. Else it takes the first of
/// these that there is:
/// 1. one for all bodies by which all stages of a step are one dispatch;
/// 2. one for all bodies by which steps can be quiet while those move that move from the start;
/// 3. the fastest for each body.
/// In 1 and 2 the fastest for what moves comes first, and then those after it in the list. Variants with one thread a vertex are
/// left out of 1 for bodies of several shares. In 2 even the largest body has to fit.
[[nodiscard]] std::vector<std::size_t> choose_force_variants(const ForceAbilities& device, std::span<const ForceBody> bodies);

}  // namespace pliant
