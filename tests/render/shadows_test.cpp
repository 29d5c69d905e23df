// Light that bodies take from each other and from the ground.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>
#include <vector>

#include "gl/context.hpp"
#include "render/sphere_pictures.hpp"
#include "support/pictures.hpp"

using namespace pliant;
using namespace pliant::render;
using namespace pliant::test;

namespace {

/// Directions of a plane at right angles to each other: `across` runs up towards the light.
struct Tilt {
  glm::dvec3 along, across, normal;
};

/// `sine` is the sine of the light's height above the plane. The plane is turned from the light towards the camera.
Tilt tilted(double sine) {
  const glm::dvec3 along = glm::normalize(glm::cross(to_light, front.eye)), towards_eye = glm::cross(along, to_light);
  const glm::dvec3 normal = sine * to_light + std::sqrt(1 - sine * sine) * towards_eye;
  return {along, glm::cross(normal, along), normal};
}

/// A white square about the origin, from -1 to 1 along both directions.
Subject plate(const Tilt& tilt) {
  const auto& [along, across, normal] = tilt;
  Subject subject;
  subject.model.bodies.emplace_back();
  subject.model.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const glm::dvec3& corner : {-along - across, along - across, along + across, across - along}) {
    subject.model.rest_positions.emplace_back(glm::vec3(corner), 0.0f);
    subject.world.emplace_back(glm::vec3(corner), 1.0f);
  }
  return subject;
}

/// Places all over a plate but for its rim.
std::vector<glm::dvec3> places_on(const Tilt& tilt) {
  std::vector<glm::dvec3> places;
  for (int i = -15; i <= 15; ++i) {
    for (int j = -15; j <= 15; ++j) places.push_back(0.06 * i * tilt.along + 0.06 * j * tilt.across);
  }
  return places;
}

/// The same surface as a container, which casts no shadows and shows the sides that are turned away.
Subject as_container(Subject subject) {
  for (auto& corners : subject.model.triangles) std::swap(corners[1], corners[2]);
  for (ModelBody& body : subject.model.bodies) body.is_container = true;
  return subject;
}

/// How much brighter or darker a body is at some of its places than the same body where nothing casts shadows.
int shadow_on_itself(const Subject& body, const std::vector<glm::dvec3>& places, double half_box) {
  RenderOptions options = without_ground();
  options.scene = {glm::dvec3(-half_box), glm::dvec3(half_box)};
  const Image image = draw(body, options), without_shadows = draw(as_container(body), options);
  int largest = 0;
  for (const glm::dvec3& place : places)
    largest = std::max(largest, std::abs(brightness_at(image, place) - brightness_at(without_shadows, place)));
  return largest;
}

/// The camera `front`, moved there and as much nearer.
CameraDescription front_of(const glm::dvec3& place, double size) {
  return {place + size * front.eye, place, front.field_of_view};
}

/// How much darker the ground is in the shadow of a sphere of this radius that lies there than at the mirror image of the shadow
/// on the lit side. The camera sees the sphere as `front` sees one of radius 1.
int contrast_of_shadow(RenderOptions options, const Subject& bodies, const glm::dvec3& centre, double radius) {
  options.camera = front_of(centre, radius);
  options.ground_height = centre.y - 1.1 * radius;
  const Image image = draw(bodies, options);
  const auto on_ground = [&](double x) {
    return brightness_at(image, centre + radius * glm::dvec3(x, -1.1, -0.5), options.camera);
  };
  return on_ground(-1.3) - on_ground(1.3);
}

Subject small_sphere(const glm::dvec3& centre, double radius) { return scaled(sphere(centre), static_cast<float>(radius)); }

}  // namespace

TEST_CASE("a body darkens the ground around it and never brightens it", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  const GroundChange change = change_of_ground(sphere({0, 0, 0}), options);
  CHECK(change.darkest > 40);
  CHECK(change.brightest <= 1);
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
    return change_of_ground(sphere({0, 0, 0}), options).darkest;
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

TEST_CASE("a body casts its shadow from however far beyond the light's box", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.scene = {{-1, -1, -1}, {1, 1, 1}};
  const Subject lower = sphere({0, 0, 0});
  const int alone = brightness_at(draw(lower, options), to_light);
  for (const double distance : {3.0, 10.0, 100.0}) {
    CAPTURE(distance);
    CHECK(brightness_at(draw(together(lower, sphere(distance * to_light)), options), to_light) < alone - 60);
  }
}

TEST_CASE("a round body alone is as bright as where nothing casts shadows", "[gl]") {
  const gl::Context context(0);
  std::vector<glm::dvec3> facing_light = places_seen();  // flat triangles shade each other where the light is lower
  std::erase_if(facing_light, [](const glm::dvec3& place) { return glm::dot(place, to_light) < 0.1; });
  for (const double half_box : {1.0, 2.0, 6.0}) {  // from fine texels of the shadow map to coarse ones
    CAPTURE(half_box);
    CHECK(shadow_on_itself(sphere({0, 0, 0}), facing_light, half_box) <= 6);
  }
}

TEST_CASE("a flat body alone is as bright as where nothing casts shadows, down to a light 6 degrees above it", "[gl]") {
  const gl::Context context(0);
  for (const double sine : {0.8, 0.3, 0.15, 0.1}) {
    CAPTURE(sine);
    CHECK(shadow_on_itself(plate(tilted(sine)), places_on(tilted(sine)), 1) <= 3);
  }
}

TEST_CASE("a sheet casts its shadow on another that is close behind it", "[gl]") {
  const gl::Context context(0);
  const Tilt tilt = tilted(0.5);
  const double gap = 0.05;  // [m], a dozen texels of the shadow map: more than keeps bodies from shadowing themselves
  Subject sheet = scaled(plate(tilt), 0.3f);
  for (auto& p : sheet.world) p += glm::vec4(gap * tilt.normal, 0);
  RenderOptions options = without_ground();
  options.scene = {glm::dvec3(-1), glm::dvec3(1)};
  options.camera.field_of_view = 8;
  const Image image = draw(together(plate(tilt), sheet), options);
  // The strip lies beyond the sheet's edge, away from the light. It is the middle of the shadow of a light 30 degrees above.
  const glm::dvec3 strip = tilt.across * (0.3 + 0.5 * gap * std::sqrt(3.0));
  CHECK(brightness_at(image, -strip, options.camera) < brightness_at(image, strip, options.camera) - 60);
}

TEST_CASE("a body hides a part of the sky from the ground beside it, and less from ground farther away", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  const Image image = draw(sphere({0, 0, 0}), options), empty = draw({}, options);
  const auto darkened = [&](double distance) {
    const glm::dvec3 place = glm::dvec3(-0.7, 0, 0.7) * distance + glm::dvec3(0, -1.1, 0);  // the key light reaches it
    return brightness_at(empty, place) - brightness_at(image, place);
  };
  CHECK(darkened(1) > 15);
  CHECK(darkened(3) < darkened(1) / 3);
}

TEST_CASE("a body is darker in the cleft beside another, though the light reaches it", "[gl]") {
  const gl::Context context(0);
  const glm::dvec3 in_cleft(-0.12, 0, 0.475), far_side(-1.9, 0, 0.43);
  for (const double shade : {0.0, 1.0}) {  // a black body only mirrors light, a white one scatters nearly all of it
    const Subject left = sphere({-1, 0, 0}, glm::dvec3(shade));
    const Image alone = draw(left), beside = draw(together(left, sphere({1, 0, 0})));
    CAPTURE(shade);
    CHECK(brightness_at(beside, in_cleft) < brightness_at(alone, in_cleft) - (shade > 0 ? 20 : 8));
    CHECK(std::abs(brightness_at(beside, far_side) - brightness_at(alone, far_side)) <= 3);
  }
}

TEST_CASE("a body casts its shadow however far it is from where bodies start", "[gl]") {
  const gl::Context context(0);
  for (const glm::dvec3& place :
       {glm::dvec3(8, 0, 0), glm::dvec3(60, 0, -35), glm::dvec3(-400, 3, 10), -6.0 * to_light, 6.0 * to_light}) {
    CAPTURE(place.x);
    CHECK(contrast_of_shadow(without_ground(), sphere(place), place, 1) > 60);
  }
}

TEST_CASE("a small body in a wide scene casts its shadow, also beside bodies that are far away or out of view", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.scene = {glm::dvec3(-100), glm::dvec3(100)};
  const glm::dvec3 place(20, 0, 5);
  const Subject small = small_sphere(place, 0.3);
  CHECK(contrast_of_shadow(options, small, place, 0.3) > 60);
  CHECK(contrast_of_shadow(options, together(small, sphere({20, 0, -60})), place, 0.3) > 60);
  CHECK(contrast_of_shadow(options, together(small, sphere({-70, 0, 40})), place, 0.3) > 60);
}

TEST_CASE("a small body casts its shadow on a wide one that it lies on", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.scene = {glm::dvec3(-60, -1, -60), glm::dvec3(60, 1, 60)};
  const glm::dvec3 place(10, 0.31, 4);
  options.camera = front_of(place, 0.3);
  Subject slab = sphere({0, 0, 0}, glm::dvec3(0.6), "box:80,1,80,8");
  for (glm::vec4& p : slab.world) p.y -= 0.5f;
  const Image image = draw(together(slab, small_sphere(place, 0.3)), options);
  const auto on_slab = [&](double x) { return brightness_at(image, {place.x + x, 0, place.z - 0.15}, options.camera); };
  CHECK(on_slab(0.4) < on_slab(-0.4) - 60);
}

TEST_CASE("a body out of view still casts its shadow into the picture", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.scene = {glm::dvec3(-50), glm::dvec3(50)};
  options.ground_height = -1;
  const Subject seen = small_sphere({1, -0.7, 0}, 0.3), above = sphere(12.0 * to_light);
  const auto ground_below_it = [&](const Subject& bodies) {
    return brightness_at(draw(bodies, options), to_light * (-1 / to_light.y));
  };
  CHECK(ground_below_it(together(seen, above)) < ground_below_it(seen) - 60);
}

TEST_CASE("a body's shadow does not shimmer while another moves and light follows both", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.camera = front_of({21, 0, 0}, 1);
  options.ground_height = -1.1;
  const auto left_half = [&](double way) {
    Image image = draw(together(sphere({20, 0, 0}), sphere({23 + way, 0, 0})), options);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      if (i / 3 % image.width > image.width / 2) image.pixels[i] = 0;
    return image;
  };
  const Image first = left_half(0);
  for (const double way : {0.003, 0.02, 0.07, 0.11, 0.16}) {
    CAPTURE(way);
    CHECK(mean_difference(left_half(way), first) < 0.01);  // it is up to 0.03 where maps follow by parts of texels
  }
}

TEST_CASE("no light comes into a closed body", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  for (const glm::dvec3& towards : {to_light, -to_light, glm::dvec3(1, 0, 0), glm::dvec3(0.1, -1, 0)}) {
    options.camera = {0.3 * towards, towards, 70};
    const Image image = draw(sphere({0, 0, 0}, glm::dvec3(1)), options);
    CHECK(std::ranges::max(image.pixels) < 60);
  }
}
