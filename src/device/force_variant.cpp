#include "device/force_variant.hpp"

#include <algorithm>

#include "core/expect.hpp"

namespace pliant {

std::size_t fastest_force_variant(std::span<const ForceVariant> variants, std::uint32_t vertices_in_all,
                                  std::uint32_t vertices_of_body) {
  const auto fastest = std::ranges::find_if(variants, [&](const ForceVariant& variant) {
    return variant.most_vertices > 0 && vertices_in_all <= variant.most_vertices && variant.suits(vertices_of_body);
  });
  PLIANT_EXPECT(fastest != variants.end());
  return static_cast<std::size_t>(fastest - variants.begin());
}

}  // namespace pliant
