// A renderer promises pictures that depend on nothing but the bodies, the camera and the size.
#include "render/frame_renderer.hpp"

#include <catch2/catch.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "gl/objects.hpp"
#include "render/sphere_pictures.hpp"
#include "support/pictures.hpp"

using namespace pliant;
using namespace pliant::render;
using namespace pliant::test;

TEST_CASE("the same scene gives the same picture, bit for bit", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0.2, 0, 0});
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  CHECK(draw(subject, options).pixels == draw(subject, options).pixels);
}

TEST_CASE("positions may begin anywhere in their buffer", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0.2, 0, 0});
  gl::Buffer positions((subject.world.size() + 17) * sizeof(glm::vec4), "positions");
  positions.write(17 * sizeof(glm::vec4), std::as_bytes(std::span(subject.world)));
  FrameRenderer renderer(subject.model, without_ground());
  renderer.draw(positions.id(), 17);
  CHECK(renderer.read().pixels == draw(subject).pixels);
}

TEST_CASE("a picture is drawn anew for every draw and camera, and shows nothing of earlier ones", "[gl]") {
  const gl::Context context(0);
  Drawing drawing(sphere({0, 0, 0}));
  const auto seen_from = [&](const CameraDescription& camera) {
    drawing.renderer.set_camera(camera);
    return drawing.picture().pixels;
  };
  const CameraDescription aside{{3, 1, 9}, {2, 0, 0}, 40};
  const auto first = seen_from(front), second = seen_from(aside);
  CHECK(first != second);
  CHECK(seen_from(front) == first);
}

TEST_CASE("lights and shadows stay where they are when a camera is set", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  Drawing drawing(sphere({0, 0, 0}), options);
  const CameraDescription behind{{0, 1, -7}, {0, 0, 0}, 40};
  drawing.renderer.set_camera(behind);
  const Image image = drawing.picture();
  const auto left_of_right = [&](const glm::dvec3& right) {
    return brightness_at(image, {-right.x, right.y, right.z}, behind) - brightness_at(image, right, behind);
  };
  CHECK(left_of_right({0.8, 0.4, -0.4}) > 60);   // on the body
  CHECK(left_of_right({1.3, -1.1, -0.5}) > 60);  // on the ground, in the shadow
}

TEST_CASE("where depths are seldom cleared a picture shows nothing of earlier ones", "[gl]") {
  const gl::Context context(0);
  RenderOptions seldom = without_ground();
  seldom.pictures_per_clear = 3;
  Drawing always(sphere({0, 0, 0})), seldom_cleared(sphere({0, 0, 0}), seldom);
  for (int k = 0; k < 8; ++k) {
    CAPTURE(k);
    for (Drawing* drawing : {&always, &seldom_cleared})
      drawing->renderer.set_camera({{k % 2 == 0 ? 3 : -3, 1, 9}, {k, 0, 0}, 40});
    CHECK(are_alike(always.picture(), seldom_cleared.picture()));
  }
}

TEST_CASE("where depths are seldom cleared bodies leave no shadows behind", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.scene = {glm::dvec3(-1), glm::dvec3(1)};
  options.ground_height = -1.1;
  RenderOptions seldom = options;
  seldom.pictures_per_clear = 3;
  const Subject lower = sphere({0, 0, 0});
  Drawing always(together(lower, lower), options), seldom_cleared(together(lower, lower), seldom);
  for (int k = 0; k < 8; ++k) {  // the other body is near, far beyond the light's box, or not before the light at all
    const glm::dvec3 places[] = {2.5 * to_light, 10.0 * to_light, {3, 0.5, 0}};
    const Subject both = together(lower, sphere(places[k % 3]));
    CAPTURE(k);
    for (Drawing* drawing : {&always, &seldom_cleared}) drawing->positions.write(0, std::as_bytes(std::span(both.world)));
    CHECK(are_alike(always.picture(), seldom_cleared.picture()));
  }
}

TEST_CASE("a container shows its far walls alone, and casts no shadow", "[gl]") {
  const gl::Context context(0);
  Subject walls = scaled(sphere({0, 0, 0}, {0.1, 0.1, 0.8}), 2.5f);
  const Subject ball = sphere({0, 0, 0});
  Subject held = together(ball, walls);
  const Image without = draw(ball), hidden = draw(held);
  held.model.bodies.back().is_container = true;
  const Image seen = draw(held);
  const auto pixel = [](const Image& image, const glm::dvec3& place) {
    const glm::ivec2 at = pixel_of(place);
    const std::size_t first = 3 * (static_cast<std::size_t>(at.y) * image.width + static_cast<std::size_t>(at.x));
    return std::vector<std::uint8_t>(image.pixels.begin() + static_cast<std::ptrdiff_t>(first),
                                     image.pixels.begin() + static_cast<std::ptrdiff_t>(first) + 3);
  };
  CHECK(pixel(seen, {0, 0, 1}) == pixel(without, {0, 0, 1}));
  CHECK(pixel(hidden, {0, 0, 1}) != pixel(without, {0, 0, 1}));
  const std::vector<std::uint8_t> beside = pixel(seen, {1.6, 0, 0});
  CHECK(beside != pixel(without, {1.6, 0, 0}));
  CHECK(beside[2] > 2 * beside[0]);  // the walls' blue
}

TEST_CASE("a resized renderer draws what one of that size would, bit for bit", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0.4, 0, 0});
  Drawing drawing(subject);
  for (const glm::uvec2 size : {glm::uvec2(90, 200), glm::uvec2(1, 1), picture_size}) {
    RenderOptions options = without_ground();
    options.size = size;
    drawing.renderer.resize(size);
    const Image resized = drawing.picture();
    CHECK(resized.width == size.x);
    CHECK(resized.height == size.y);
    CHECK(resized.pixels == draw(subject, options).pixels);
  }
}

TEST_CASE("a scene turned together with its camera has the same picture, as the light turns, too", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.6;
  Subject subject = sphere({0.9, -0.2, 0.4});
  const Image before = draw(subject, options);
  for (auto& p : subject.world) p = {p.z, p.y, -p.x, 1};
  options.camera.eye = {front.eye.z, front.eye.y, -front.eye.x};
  CHECK(mean_difference(draw(subject, options), before) < 0.5);
}

TEST_CASE("a scene far from the origin has the same picture", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  Subject subject = sphere({0.3, 0, 0});
  const float finest = 1.0f / 512;  // floats hold it at 10 km, too
  for (auto& p : subject.world) p = glm::round(p / finest) * finest;
  const Image near_origin = draw(subject, options);
  const glm::dvec3 far_away(8192, -4096, 8192);
  for (auto& p : subject.world) p += glm::vec4(far_away, 0);
  options.camera.eye += far_away;
  options.camera.target += far_away;
  options.scene = {options.scene.low + far_away, options.scene.high + far_away};
  *options.ground_height += far_away.y;
  CHECK(largest_difference(draw(subject, options), near_origin) <= 2);
}

TEST_CASE("an observer hears each pass once, in the order in which they are queued", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0, 0, 0});
  gl::Buffer positions(subject.world.size() * sizeof(glm::vec4), "positions");
  FrameRenderer renderer(subject.model, without_ground());
  std::vector<std::string> passes;
  renderer.draw(positions.id(), 0, [&](const char* pass) { passes.emplace_back(pass); });
  CHECK(passes == std::vector<std::string>{"normals", "shadow", "ground", "seen", "occlusion", "shading"});
}
