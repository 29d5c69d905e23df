// How far two pictures are apart.
#pragma once
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "render/frame_renderer.hpp"

namespace pliant {

/// Of 255, over all pixels and channels. Expects pictures of one size.
inline int largest_difference(const render::Image& a, const render::Image& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  int largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) largest = std::max(largest, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
  return largest;
}

/// Of pictures of the same thing where depths are seldom cleared: they round in one way or another.
inline constexpr int rounding_of_depths = 4;

}  // namespace pliant
