// How the GPU's threads share the springs of bodies (shaders/compute/force.comp).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "device/force_variant.hpp"

namespace pliant::gpu {

/// How force.comp cuts its work.
struct Lanes {
  std::uint32_t lanes, vertices, teams, unroll;
  std::uint32_t plainly;  // springs that a lane adds up plainly, before it adds this sum exactly
  std::uint32_t tile;     // vertices fetched at a time where groups run all stages, 0 if there is no room. It is what shared
                          // memory has room for, in multiples that keep the order of additions
  std::uint32_t most_vertices;                // of all that move, up to which this is the fastest; 0: another one always is
  std::uint32_t smallest_body, largest_body;  // in vertices: for others, another one is faster

  [[nodiscard]] std::uint32_t keepers() const { return lanes == 1 ? 0 : (3 * vertices * teams + 31) / 32 * 32; }
  [[nodiscard]] std::uint32_t threads() const { return lanes * teams + keepers(); }
};

[[nodiscard]] std::span<const Lanes> lane_choices();

/// Returns them in the same order, as a GPU with so many multiprocessors has them, or as software that runs shaders has them.
[[nodiscard]] std::vector<ForceVariant> force_variants(bool is_software, std::uint32_t multiprocessors);

}  // namespace pliant::gpu
