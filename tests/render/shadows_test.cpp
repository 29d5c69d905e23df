// Light that bodies take from each other and from the ground.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "gl/context.hpp"
#include "render/sphere_pictures.hpp"

using namespace pliant;
using namespace pliant::render;
using namespace pliant::test;

TEST_CASE("a body darkens the ground around it and never brightens it", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  const Subject subject = sphere({0, 0, 0});
  const Image shadowed = draw(subject, options), empty = draw({}, options);
  const Silhouette body{draw(subject)};
  int darkest = 0, brightest = 0;
  for (std::size_t i = 0; i < shadowed.pixels.size(); ++i) {
    if (body.near(static_cast<int>(i / 3 % picture_size.x), static_cast<int>(i / 3 / picture_size.x))) continue;
    const int change = int{shadowed.pixels[i]} - int{empty.pixels[i]};
    darkest = std::min(darkest, change);
    brightest = std::max(brightest, change);
  }
  CHECK(darkest < -40);
  CHECK(brightest <= 1);
}

TEST_CASE("the ground is darker in a body's shadow than at the shadow's mirror image on the lit side", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  const Image image = draw(sphere({0, 0, 0}), options);  // the light is behind the camera's left shoulder
  CHECK(brightness_at(image, {1.3, -1.1, -0.5}) < brightness_at(image, {-1.3, -1.1, -0.5}) - 60);
}

TEST_CASE("a camera from far away with a narrow view sees the shadow as one nearby does", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  const auto contrast = [&](double times) {
    const double slope = std::tan(glm::radians(front.field_of_view) / 2) / times;
    options.camera = {front.eye * times, front.target, 2 * glm::degrees(std::atan(slope))};
    RenderOptions floating = options;
    floating.ground_height.reset();
    const Image empty = draw({}, options), image = draw(sphere({0, 0, 0}), options);
    const Silhouette body{draw(sphere({0, 0, 0}), floating), floating};
    int darkest = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      if (body.near(static_cast<int>(i / 3 % picture_size.x), static_cast<int>(i / 3 / picture_size.x))) continue;
      darkest = std::max(darkest, empty.pixels[i] - image.pixels[i]);
    }
    return darkest;
  };
  CHECK(contrast(20) > contrast(1) / 2);
}

TEST_CASE("a shadow is softer where its caster is higher", "[gl]") {
  const gl::Context context(0);
  const auto rim_of_shadow = [](double height) {
    RenderOptions options = without_ground();
    options.ground_height = -1.1;
    options.camera = {{0, 14, 0.01}, {0, 0, 0}, 40};
    options.scene = {{-2, -2, -2}, {2, 4, 2}};
    const Image image = draw(sphere({0, height, 0}), options), empty = draw({}, options);
    const Silhouette shadow{image, options};
    int steepest = 0;
    for (std::size_t i = 3; i < image.pixels.size(); ++i) {
      const int change = image.pixels[i] - empty.pixels[i], before = image.pixels[i - 3] - empty.pixels[i - 3];
      const int x = static_cast<int>(i / 3 % picture_size.x), y = static_cast<int>(i / 3 / picture_size.x);
      const double from_body = std::hypot(x - picture_size.x / 2.0, y - picture_size.y / 2.0);
      if (from_body > 26) steepest = std::max(steepest, std::abs(change - before));
    }
    return steepest;
  };
  CHECK(rim_of_shadow(2.5) < rim_of_shadow(0.2));
}

TEST_CASE("a body is darker where another stands between it and the light", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.scene = {{-3, -2, -2}, {2, 4, 3}};
  const Subject lower = sphere({0.5, -0.5, 0});
  const glm::dvec3 lit = glm::dvec3(0.5, -0.5, 0) + to_light;
  const int alone = brightness_at(draw(lower, options), lit);
  CHECK(brightness_at(draw(together(lower, sphere(glm::dvec3(0.5, -0.5, 0) + 3.0 * to_light)), options), lit) < alone - 60);
}

TEST_CASE("a body is darker in the cleft beside another, though the light reaches it", "[gl]") {
  const gl::Context context(0);
  const Subject left = sphere({-1, 0, 0});
  const glm::dvec3 in_cleft(-0.12, 0, 0.475), far_side(-1.9, 0, 0.43);
  const Image alone = draw(left), beside = draw(together(left, sphere({1, 0, 0})));
  CHECK(brightness_at(beside, in_cleft) < brightness_at(alone, in_cleft) - 8);
  CHECK(std::abs(brightness_at(beside, far_side) - brightness_at(alone, far_side)) <= 3);
}
