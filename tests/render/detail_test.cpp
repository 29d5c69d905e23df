// How little a picture depends on its size and its level of detail.
#include <catch2/catch.hpp>

#include "gl/context.hpp"
#include "render/sphere_pictures.hpp"
#include "support/pictures.hpp"

using namespace pliant;
using namespace pliant::render;
using namespace pliant::test;

namespace {

/// Of half the width and height: each pixel the mean of four.
Image halved(const Image& image) {
  Image half{image.width / 2, image.height / 2, {}};
  for (std::uint32_t y = 0; y < half.height; ++y) {
    for (std::uint32_t i = 0; i < 3 * half.width; ++i) {
      const std::size_t first = std::size_t{3} * (2 * y * image.width + 2 * (i / 3)) + i % 3,
                        below = first + std::size_t{3} * image.width;
      const int sum = image.pixels[first] + image.pixels[first + 3] + image.pixels[below] + image.pixels[below + 3];
      half.pixels.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
    }
  }
  return half;
}

}  // namespace

TEST_CASE("a picture of twice the size shows the same", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  const Subject subject = together(sphere({-1, 0, 0}), sphere({1, 0.1, 0.3}));
  const Image once = draw(subject, options);
  options.size = picture_size * 2u;
  CHECK(mean_difference(halved(draw(subject, options)), once) < 1);
}

TEST_CASE("reduced detail shows the same, but for rims of shadows and inner outlines", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  const Subject subject = together(sphere({-1, 0, 0}), sphere({1, 0.1, 0.3}));
  const Image full = draw(subject, options);
  options.detail = Detail::reduced;
  CHECK(mean_difference(draw(subject, options), full) < 1);
}
