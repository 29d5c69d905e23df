// Which pixels a body covers.
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "gl/context.hpp"
#include "render/sphere_pictures.hpp"
#include "support/pictures.hpp"

using namespace pliant;
using namespace pliant::render;
using namespace pliant::test;

namespace {

/// The share of rows in which the first pixel of a red body is less red than the next. Only rows that run into the body count.
/// The first pixel has 1, 2, 3 or 4 of its four samples on the body, each as often.
double smooth_share(const Image& image) {
  int rows = 0, smooth = 0;
  for (std::size_t y = 0; y < image.height; ++y) {
    const auto redness = [&](std::size_t x) {
      const std::size_t first = 3 * (y * image.width + x);
      return image.pixels[first] - image.pixels[first + 2];
    };
    std::size_t x = 1;
    while (x + 1 < image.width && redness(x) - redness(x - 1) <= 20) ++x;
    if (x + 1 == image.width) continue;
    ++rows;
    smooth += redness(x) - redness(x - 1) < (redness(x + 1) - redness(x - 1)) * 3 / 4;
  }
  REQUIRE(rows > 40);
  return static_cast<double>(smooth) / rows;
}

}  // namespace

TEST_CASE("a sphere covers the pixels that a pinhole camera says it covers", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0.7, 0.3, -0.5});
  const PixelBox seen = box_of(Silhouette(draw(subject))), expected = pinhole_box(subject.world, front);
  CHECK(seen.left == Approx(expected.left).margin(2));
  CHECK(seen.right == Approx(expected.right).margin(2));
  CHECK(seen.top == Approx(expected.top).margin(2));
  CHECK(seen.bottom == Approx(expected.bottom).margin(2));
}

TEST_CASE("a mirrored scene has the mirrored silhouette, to a pixel", "[gl]") {
  const gl::Context context(0);
  Subject subject = sphere({1.1, 0.4, 0.3});
  for (auto& p : subject.world) p.y *= 1.4f + 0.2f * p.x;  // nothing symmetric about it
  const Silhouette original{draw(subject)};
  for (auto& p : subject.world) p.x = -p.x;
  const Silhouette mirrored{draw(subject)};
  REQUIRE(original.area() > 1000);
  bool matches = true;
  for (int y = 0; y < static_cast<int>(picture_size.y); ++y) {
    for (int x = 0; x < static_cast<int>(picture_size.x); ++x) {
      const int opposite = static_cast<int>(picture_size.x) - 1 - x;
      if (original.at(x, y)) matches = matches && mirrored.near(opposite, y);
      if (mirrored.at(opposite, y)) matches = matches && original.near(x, y);
    }
  }
  CHECK(matches);
}

TEST_CASE("a wireframe lies within the surface's outline, reaches it, and leaves gaps", "[gl]") {
  const gl::Context context(0);
  Drawing drawing(sphere({0.2, 0, 0}, {0.8, 0.1, 0.05}, "icosphere:1"));
  const Image surface = drawing.picture();
  drawing.renderer.set_fill(Fill::wireframe);
  const Silhouette whole{surface}, wires{drawing.picture()};
  const PixelBox of_whole = box_of(whole), of_wires = box_of(wires);
  CHECK(of_wires.left == Approx(of_whole.left).margin(1));
  CHECK(of_wires.right == Approx(of_whole.right).margin(1));
  CHECK(of_wires.top == Approx(of_whole.top).margin(1));
  CHECK(of_wires.bottom == Approx(of_whole.bottom).margin(1));
  CHECK(wires.area() < whole.area() * 9 / 10);
  drawing.renderer.set_fill(Fill::surface);
  CHECK(drawing.picture().pixels == surface.pixels);
}

TEST_CASE("outlines before the backdrop are smoothed", "[gl]") {
  const gl::Context context(0);
  for (const Detail detail : {Detail::full, Detail::reduced}) {
    RenderOptions options = without_ground();
    options.detail = detail;
    CHECK(smooth_share(draw(sphere({0.4, 0, 1.2}), options)) > 0.4);
  }
}

TEST_CASE("outlines before another body are smoothed in full detail alone", "[gl]") {
  const gl::Context context(0);
  const Subject subject = together(scaled(sphere({-0.3, 0, -1.5}, {0, 0, 0}), 2.2f), sphere({0.4, 0, 1.2}));
  RenderOptions options = without_ground();
  CHECK(smooth_share(draw(subject, options)) > 0.4);
  options.detail = Detail::reduced;
  CHECK(smooth_share(draw(subject, options)) < 0.1);
}

TEST_CASE("a vertex that is not finite takes its triangles out of the picture and nothing else", "[gl]") {
  const gl::Context context(0);
  const Subject good = sphere({1.8, 0.5, 0});
  const Silhouette whole{draw(good)};
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e38f}) {
    Subject subject = good;
    std::ranges::min_element(subject.world, {}, &glm::vec4::x)->y = bad;  // on the outline
    const Silhouette holed{draw(subject)};
    CHECK(holed.area() > whole.area() * 95 / 100);
    CHECK(std::ranges::equal(holed.covered, whole.covered, [](bool part, bool all) { return all || !part; }));
    for (auto& p : subject.world) p.x = bad;
    CHECK(Silhouette(draw(subject)).area() == 0);
  }
}

TEST_CASE("both sides of an open surface are drawn", "[gl]") {
  const gl::Context context(0);
  Subject outside = sphere({0, 0, 0});
  Subject inside = outside;
  for (auto& triangle : inside.model.triangles) std::swap(triangle[1], triangle[2]);
  CHECK(Silhouette(draw(inside)).area() == Silhouette(draw(outside)).area());
  CHECK(largest_difference(draw(inside), draw(outside)) <= 2);
}
