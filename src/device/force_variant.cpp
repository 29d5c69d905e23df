#include "device/force_variant.hpp"

#include <algorithm>

#include "core/expect.hpp"

namespace pliant {

std::size_t best_force_variant(std::span<const ForceVariant> variants, std::uint32_t moving_vertices,
                               std::uint32_t vertices_of_body) {
  const auto best = std::ranges::find_if(variants, [&](const ForceVariant& variant) {
    return variant.most_vertices > 0 && moving_vertices <= variant.most_vertices && variant.suits(vertices_of_body);
  });
  PLIANT_EXPECT(best != variants.end());
  return static_cast<std::size_t>(best - variants.begin());
}

}  // namespace pliant
