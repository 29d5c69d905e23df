// How little a picture depends on its size and its level of detail.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "gl/context.hpp"
#include "render/sphere_pictures.hpp"
#include "support/pictures.hpp"

using namespace pliant;
using namespace pliant::render;
using namespace pliant::test;

namespace {

/// The image at half the width and height. Each pixel is the mean of four.
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

/// A small sphere casts a soft shadow on a larger one.
Subject sphere_in_shadow() {
  return together(sphere({0, 0, 0}, {0.5, 0.5, 0.5}, "icosphere:4"), scaled(sphere(2.5 * to_light), 0.4f));
}

RenderOptions in_reduced_detail() {
  RenderOptions options = without_ground();
  options.detail = Detail::reduced;
  return options;
}

/// The mean difference of two pictures over the pixels of a silhouette, of 255.
double mean_difference_within(const Silhouette& silhouette, const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += silhouette.covered[i / 3] ? std::abs(a.pixels[i] - b.pixels[i]) : 0;
  return sum / (3.0 * static_cast<double>(silhouette.area()));
}

/// The largest second difference of brightness along a row, where the light meets the shadowed sphere steeply.
int roughest(RenderOptions options) {
  options.camera.field_of_view = 17;  // a rim is many pixels wide
  const Image image = draw(sphere_in_shadow(), options);
  int roughest = 0;
  for (const glm::dvec3& place : places_seen()) {
    if (glm::dot(place, to_light) < 0.5) continue;
    const glm::ivec2 pixel = pixel_of(place, options.camera), next(1, 0);
    const int bend = brightness(image, pixel - next) - 2 * brightness(image, pixel) + brightness(image, pixel + next);
    roughest = std::max(roughest, std::abs(bend));
  }
  return roughest;
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

TEST_CASE("reduced detail shows bodies and their shadows, but for rims and outlines", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere_in_shadow();
  const Image full = draw(subject), reduced = draw(subject, in_reduced_detail());
  CHECK(mean_difference_within(Silhouette(full), full, reduced) < 3);
}

TEST_CASE("rims of shadows on bodies have finer steps in full detail", "[gl]") {
  const gl::Context context(0);
  // In full detail a tap is a sixteenth of the light, not a fourth.
  CHECK(roughest(without_ground()) < roughest(in_reduced_detail()) * 2 / 3);
}

TEST_CASE("small bodies' shadows on the ground are darker in full detail, but take as much light in reduced", "[gl]") {
  const gl::Context context(0);
  // In reduced detail the ground averages more than their width. They are far enough from each other to need the whole map.
  const Subject small = together(scaled(sphere({-1.2, -0.55, 0}), 0.15f), scaled(sphere({1.2, -0.55, 0}), 0.15f));
  RenderOptions options = without_ground(), fewer = in_reduced_detail();
  options.ground_height = fewer.ground_height = -1.1;
  const GroundChange full = change_of_ground(small, options), reduced = change_of_ground(small, fewer);
  CHECK(full.darkest > reduced.darkest * 3 / 2);
  CHECK(full.sum == Approx(reduced.sum).epsilon(0.25));
}
