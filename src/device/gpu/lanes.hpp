// How the GPU's threads share the springs of bodies (shaders/compute/force.comp).
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/force_variant.hpp"

namespace pliant::gpu {

/// How force.comp divides its work.
struct Lanes {
  std::uint32_t lanes;  // 0: the sums are given, and there are only keepers
  std::uint32_t vertices, teams, unroll;
  std::uint32_t plainly;  // springs that a lane adds up plainly, before it adds this sum exactly
  std::uint32_t tile;     // vertices fetched at a time where groups run all stages, 0 if there is no room. It is what shared
                          // memory has room for, in multiples that keep the order of additions

  [[nodiscard]] std::uint32_t keepers() const { return lanes == 1 ? 0 : (3 * vertices * teams + 31) / 32 * 32; }
  [[nodiscard]] bool cancels_rounding() const { return vertices == 1 || lanes == 1; }
  [[nodiscard]] std::uint32_t threads() const { return lanes * teams + keepers(); }
};

/// What the variants of a GPU depend on.
struct Processors {
  bool are_software = false;
  std::uint32_t multiprocessors = 0;  // 0 if the driver does not tell
};

[[nodiscard]] std::vector<ForceVariant> force_variants(const Processors& gpu);

/// Returns the variant for sums that are given.
[[nodiscard]] ForceVariant variant_for_given_sums();

/// Returns how one of these variants divides its work, or behind them that for given sums. That is the same on every GPU.
[[nodiscard]] const Lanes& lanes_of(std::size_t variant);

}  // namespace pliant::gpu
