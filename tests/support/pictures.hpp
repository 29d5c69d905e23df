// How far two pictures are apart.
#pragma once
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "render/frame_renderer.hpp"

namespace pliant {

/// The largest difference over all pixels and channels, of 255. Expects pictures of one size.
inline int largest_difference(const render::Image& a, const render::Image& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  int largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) largest = std::max(largest, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
  return largest;
}

/// The mean difference over all pixels and channels, of 255. Expects pictures of one size.
inline double mean_difference(const render::Image& a, const render::Image& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(int{a.pixels[i]} - int{b.pixels[i]});
  return sum / static_cast<double>(a.pixels.size());
}

/// Whether two pictures may be of the same thing. Depths are seldom cleared, so they round in one way or another. If two surfaces
/// are equally deep, one or the other is seen.
inline bool are_alike(const render::Image& a, const render::Image& b) { return mean_difference(a, b) < 0.02; }

}  // namespace pliant
