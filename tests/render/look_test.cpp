// What bodies and the studio around them look like.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "gl/context.hpp"
#include "render/sphere_pictures.hpp"

using namespace pliant;
using namespace pliant::render;
using namespace pliant::test;

namespace {

const glm::dvec3 black(0.0), grey(0.5), white(1.0);

/// Cosine of the angle between a sphere's normal and the one that would mirror the key light into the camera `front`.
double mirrors_light(const glm::dvec3& place) {
  return glm::dot(place, glm::normalize(to_light + glm::normalize(front.eye - place)));
}

}  // namespace

TEST_CASE("a black body is brightest where it mirrors the light", "[gl]") {
  const gl::Context context(0);
  const Image image = draw(sphere({0, 0, 0}, black, "icosphere:4"));
  const auto brightest =
      std::ranges::max(places_seen(), {}, [&](const glm::dvec3& place) { return brightness_at(image, place); });
  CHECK(std::acos(mirrors_light(brightest)) < 0.1);  // places are 0.07 apart, pixels 0.03
}

TEST_CASE("no light is mirrored where a body stands before it", "[gl]") {
  const gl::Context context(0);
  const Subject body = sphere({0, 0, 0}, black);
  const glm::dvec3 mirror = std::ranges::max(places_seen(), {}, mirrors_light);
  const int alone = brightness_at(draw(body), mirror);
  CHECK(brightness_at(draw(together(body, sphere(2.5 * to_light))), mirror) < alone / 4);
}

TEST_CASE("where the light does not reach a black body it mirrors what is around, more at a flatter angle", "[gl]") {
  const gl::Context context(0);
  const Image image = draw(sphere({0, 0, 0}, black));
  const glm::dvec3 facing = glm::normalize(glm::dvec3(0.6, -0.2, 0.77)), slanted = glm::normalize(glm::dvec3(0.93, -0.2, 0.3));
  REQUIRE(std::max(glm::dot(facing, to_light), glm::dot(slanted, to_light)) < 0);
  CHECK(brightness_at(image, facing) > 20);
  CHECK(brightness_at(image, slanted) > 2 * brightness_at(image, facing));
}

TEST_CASE("where the light does not reach a body it is brighter towards the fill light", "[gl]") {
  const gl::Context context(0);
  const CameraDescription aside{{7, 0, 0}, {0, 0, 0}, 40};  // all else is as bright left and right of the picture
  Drawing drawing(sphere({0, 0, 0}, grey));
  drawing.renderer.set_camera(aside);
  const Image image = drawing.picture();
  const glm::dvec3 towards = glm::normalize(glm::dvec3(0.75, -0.3, 0.6)), away(towards.x, towards.y, -towards.z);
  REQUIRE(std::max(glm::dot(towards, to_light), glm::dot(away, to_light)) < 0);
  CHECK(brightness_at(image, towards, aside) > brightness_at(image, away, aside) + 15);
}

TEST_CASE("a body mirrors the shadow that it casts on the ground, and is lit the less by the ground there", "[gl]") {
  const gl::Context context(0);
  RenderOptions above_shadow = without_ground();  // without a ground in the picture, bodies take it for lit all over
  above_shadow.ground_height = -1.1;
  const glm::dvec3 mirrors_ground = glm::normalize(glm::dvec3(0.3, -0.7, 0.6));
  const glm::dvec3 mirrors_none = glm::normalize(glm::dvec3(0.3, -0.4, 0.8));
  const auto darkened = [&](const glm::dvec3& color, const glm::dvec3& place) {
    const Subject body = sphere({0, 0, 0}, color);
    return brightness_at(draw(body), place) - brightness_at(draw(body, above_shadow), place);
  };
  CHECK(darkened(black, mirrors_ground) > 50);
  CHECK(darkened(white, mirrors_none) > 5);
}

TEST_CASE("a body mirrors the shadow of another only in soft outlines, because its surface is rough", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.0;
  options.camera.field_of_view = 17;  // a soft outline is many pixels wide
  const Subject body = sphere({0, 0, 0}, black, "icosphere:5");
  const Image alone = draw(body, options), beside = draw(together(body, sphere({2.4, 0, 0.4})), options);
  const auto darkened = [&](const glm::ivec2& pixel) { return brightness(alone, pixel) - brightness(beside, pixel); };
  int most = 0, steepest = 0;
  for (const glm::dvec3& place : places_seen()) {
    const glm::ivec2 pixel = pixel_of(place, options.camera);
    most = std::max(most, darkened(pixel));
    for (const glm::ivec2 next : {glm::ivec2(1, 0), glm::ivec2(0, 1)})
      steepest = std::max(steepest, std::abs(darkened(pixel + next) - darkened(pixel)));
  }
  CAPTURE(most, steepest);
  CHECK(most > 10);
  CHECK(steepest < most / 3);
}

TEST_CASE("a white body in full light keeps its shades", "[gl]") {
  const gl::Context context(0);
  const Image image = draw(sphere({0, 0, 0}, white));
  const auto brightness_there = [&](const glm::dvec3& place) { return brightness_at(image, place); };
  CHECK(brightness_there(std::ranges::max(places_seen(), {}, brightness_there)) < 3 * 255);
}

TEST_CASE("the ground runs into the backdrop without an edge", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  options.camera = {{0, 1, 7}, {0, 1, 0}, 60};  // the horizon is in the middle
  const Image image = draw({}, options);
  int largest = 0;
  for (int y = 1; y < static_cast<int>(picture_size.y); ++y)
    largest = std::max(largest, std::abs(brightness(image, {160, y}) - brightness(image, {160, y - 1})));
  CHECK(largest <= 15);
}

TEST_CASE("a coarse sphere is shaded as a fine one", "[gl]") {
  const gl::Context context(0);
  const Image coarse = draw(sphere({0, 0, 0}, grey, "icosphere:2")), fine = draw(sphere({0, 0, 0}, grey, "icosphere:5"));
  int largest = 0;
  for (const glm::dvec3& place : places_seen()) {
    if (glm::dot(place, to_light) < 0.3) continue;  // flat triangles shade each other where the light is low
    largest = std::max(largest, std::abs(brightness_at(coarse, place) - brightness_at(fine, place)));
  }
  CHECK(largest < 35);  // normals of neighbouring triangles are some 0.3 apart, which is a tenth of the light
}
