// Pictures of spheres, against what geometry says must be in them.
#include "render/frame_renderer.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "gl/objects.hpp"
#include "mesh/generators.hpp"
#include "support/pictures.hpp"

using namespace pliant;
using namespace pliant::render;

namespace {

constexpr glm::uvec2 picture_size{320, 180};
const CameraDescription front{{0, 1, 7}, {0, 0, 0}, 40};

/// One body, and where its vertices are.
struct Subject {
  Model model;
  std::vector<glm::vec4> world;  // [m]
};

Subject sphere(const glm::dvec3& centre, const glm::dvec3& color = {0.8, 0.1, 0.05}, const char* generator = "icosphere:3") {
  const TriangleMesh mesh = generate_mesh(generator);
  Subject subject;
  ModelBody body;
  body.name = "sphere";
  body.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  body.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
  body.color = color;
  subject.model.bodies = {body};
  subject.model.triangles = mesh.triangles;
  for (const glm::dvec3& p : mesh.positions) {
    subject.model.rest_positions.emplace_back(glm::vec3(p), 0.0f);
    subject.world.emplace_back(glm::vec3(p + centre), 1.0f);
  }
  return subject;
}

RenderOptions without_ground() {
  RenderOptions options;
  options.size = picture_size;
  options.camera = front;
  options.scene = {{-2, -2, -2}, {2, 2, 2}};
  return options;
}

Image draw(const Subject& subject, const RenderOptions& options = without_ground()) {
  gl::Buffer positions(subject.world.size() * sizeof(glm::vec4), "positions");
  positions.write(0, std::as_bytes(std::span(subject.world)));
  FrameRenderer renderer(subject.model, options);
  renderer.draw(positions.id(), 0);
  return renderer.read();
}

/// Pixels that differ from the picture without bodies.
struct Silhouette {
  explicit Silhouette(const Image& image, const RenderOptions& options = without_ground()) : covered(pixel_count(image)) {
    const Image empty = draw({}, options);
    REQUIRE(empty.pixels.size() == image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      if (image.pixels[i] != empty.pixels[i]) covered[i / 3] = true;
    }
  }
  static std::size_t pixel_count(const Image& image) { return std::size_t{image.width} * image.height; }
  [[nodiscard]] bool at(int x, int y) const {
    const int width = static_cast<int>(picture_size.x), height = static_cast<int>(picture_size.y);
    return x >= 0 && y >= 0 && x < width && y < height && covered[static_cast<std::size_t>(y * width + x)];
  }
  [[nodiscard]] bool near(int x, int y) const {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (at(x + dx, y + dy)) return true;
      }
    }
    return false;
  }
  [[nodiscard]] auto area() const { return std::ranges::count(covered, true); }

  std::vector<bool> covered;
};

struct PixelBox {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
  void add(double x, double y) {
    left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
  }
};

PixelBox box_of(const Silhouette& silhouette) {
  PixelBox box;
  for (int y = 0; y < static_cast<int>(picture_size.y); ++y) {
    for (int x = 0; x < static_cast<int>(picture_size.x); ++x) {
      if (silhouette.at(x, y)) box.add(x, y), box.add(x + 1, y + 1);
    }
  }
  return box;
}

/// A pinhole camera by similar triangles.
PixelBox pinhole_box(const std::vector<glm::vec4>& world, const CameraDescription& camera) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0))), up = glm::cross(right, forward);
  const double pixels_per_slope = picture_size.y / (2 * std::tan(camera.field_of_view * std::acos(-1.0) / 360));
  PixelBox box;
  for (const glm::vec4& p : world) {
    const glm::dvec3 d = glm::dvec3(p) - camera.eye;
    const double scale = pixels_per_slope / glm::dot(d, forward);
    box.add(picture_size.x / 2.0 + glm::dot(d, right) * scale, picture_size.y / 2.0 - glm::dot(d, up) * scale);
  }
  return box;
}

/// Sum of a pixel's red, green and blue, where the camera `front` sees a place.
int brightness_at(const Image& image, const glm::dvec3& place) {
  const PixelBox at = pinhole_box({glm::vec4(place, 1)}, front);
  const std::size_t first = 3 * (static_cast<std::size_t>(at.top) * image.width + static_cast<std::size_t>(at.left));
  return image.pixels[first] + image.pixels[first + 1] + image.pixels[first + 2];
}

Subject together(Subject a, const Subject& b) {
  const auto first = static_cast<std::uint32_t>(a.world.size());
  for (const auto& [i, j, k] : b.model.triangles) a.model.triangles.push_back({first + i, first + j, first + k});
  a.model.rest_positions.insert(a.model.rest_positions.end(), b.model.rest_positions.begin(), b.model.rest_positions.end());
  a.world.insert(a.world.end(), b.world.begin(), b.world.end());
  a.model.bodies.front().vertex_count += b.model.bodies.front().vertex_count;
  a.model.bodies.front().triangle_count += b.model.bodies.front().triangle_count;
  return a;
}

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

/// From a published sRGB colour to the linear one that a body's description wants.
glm::dvec3 linear(const glm::dvec3& srgb) { return {std::pow(srgb.x, 2.2), std::pow(srgb.y, 2.2), std::pow(srgb.z, 2.2)}; }

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
  const Subject subject = sphere({0, 0, 0});
  gl::Buffer positions(subject.world.size() * sizeof(glm::vec4), "positions");
  positions.write(0, std::as_bytes(std::span(subject.world)));
  FrameRenderer renderer(subject.model, without_ground());
  const auto seen_from = [&](const CameraDescription& camera) {
    renderer.set_camera(camera);
    renderer.draw(positions.id(), 0);
    return renderer.read().pixels;
  };
  const CameraDescription aside{{3, 1, 9}, {2, 0, 0}, 40};
  const auto first = seen_from(front), second = seen_from(aside);
  CHECK(first != second);
  CHECK(seen_from(front) == first);
}

TEST_CASE("where depths are seldom cleared a picture shows nothing of earlier ones", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0, 0, 0});
  gl::Buffer positions(subject.world.size() * sizeof(glm::vec4), "positions");
  positions.write(0, std::as_bytes(std::span(subject.world)));
  RenderOptions seldom = without_ground();
  seldom.pictures_per_clear = 3;
  FrameRenderer always(subject.model, without_ground()), seldom_cleared(subject.model, seldom);
  for (int k = 0; k < 8; ++k) {
    CAPTURE(k);
    for (FrameRenderer* renderer : {&always, &seldom_cleared}) {
      renderer->set_camera({{k % 2 == 0 ? 3 : -3, 1, 9}, {k, 0, 0}, 40});
      renderer->draw(positions.id(), 0);
    }
    CHECK(are_alike(always.read(), seldom_cleared.read()));
  }
}

TEST_CASE("bodies at rest are coloured by speed as undeformed ones by deformation, and faster ones otherwise", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0, 0, 0});
  gl::Buffer positions(subject.world.size() * sizeof(glm::vec4), "positions");
  positions.write(0, std::as_bytes(std::span(subject.world)));
  gl::Buffer motions(2 * 6 * subject.world.size() * sizeof(double), "motions");  // at rest, and as fast as the scale goes
  std::vector<double> moving(6 * subject.world.size(), 0.0);
  for (std::size_t i = 0; i < subject.world.size(); ++i) moving[6 * i + 4] = 3;
  motions.write(moving.size() * sizeof(double), std::as_bytes(std::span(moving)));
  FrameRenderer renderer(subject.model, without_ground());
  const auto picture = [&](const std::optional<Speeds>& speeds) {
    renderer.set_speeds(speeds);
    renderer.draw(positions.id(), 0);
    return renderer.read().pixels;
  };
  const auto plain = picture({});
  const auto resting = picture(Speeds{motions.id(), 0, 3}), fast = picture(Speeds{motions.id(), subject.model.vertex_count(), 3});
  CHECK((fast != resting && fast != plain && resting != plain));
  CHECK((picture({}) == plain));
  renderer.set_coloring(Coloring::deformation);
  CHECK((picture({}) == resting));
}

TEST_CASE("a resized renderer draws what one of that size would, bit for bit", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0.4, 0, 0});
  gl::Buffer positions(subject.world.size() * sizeof(glm::vec4), "positions");
  positions.write(0, std::as_bytes(std::span(subject.world)));
  FrameRenderer renderer(subject.model, without_ground());
  for (const glm::uvec2 size : {glm::uvec2(90, 200), glm::uvec2(1, 1), picture_size}) {
    RenderOptions options = without_ground();
    options.size = size;
    renderer.resize(size);
    renderer.draw(positions.id(), 0);
    const Image resized = renderer.read();
    CHECK(resized.width == size.x);
    CHECK(resized.height == size.y);
    CHECK(resized.pixels == draw(subject, options).pixels);
  }
}

TEST_CASE("a wireframe lies within the surface's outline, reaches it, and leaves gaps", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0.2, 0, 0}, {0.8, 0.1, 0.05}, "icosphere:1");
  gl::Buffer positions(subject.world.size() * sizeof(glm::vec4), "positions");
  positions.write(0, std::as_bytes(std::span(subject.world)));
  FrameRenderer renderer(subject.model, without_ground());
  renderer.draw(positions.id(), 0);
  const Image surface = renderer.read();
  renderer.set_fill(Fill::wireframe);
  renderer.draw(positions.id(), 0);
  const Silhouette whole{surface}, wires{renderer.read()};
  const PixelBox of_whole = box_of(whole), of_wires = box_of(wires);
  CHECK(of_wires.left == Approx(of_whole.left).margin(1));
  CHECK(of_wires.right == Approx(of_whole.right).margin(1));
  CHECK(of_wires.top == Approx(of_whole.top).margin(1));
  CHECK(of_wires.bottom == Approx(of_whole.bottom).margin(1));
  CHECK(wires.area() < whole.area() * 9 / 10);
  renderer.set_fill(Fill::surface);
  renderer.draw(positions.id(), 0);
  CHECK(renderer.read().pixels == surface.pixels);
}

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
  const glm::dvec3 to_light = glm::normalize(glm::dvec3(-0.55, 1.15, 0.55)), lit = glm::dvec3(0.5, -0.5, 0) + to_light;
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
  const float finest = 1.0f / 512;  // what floats hold at 10 km, too
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

TEST_CASE("a picture of twice the size shows the same", "[gl]") {
  const gl::Context context(0);
  RenderOptions options = without_ground();
  options.ground_height = -1.1;
  const Subject subject = together(sphere({-1, 0, 0}), sphere({1, 0.1, 0.3}));
  const Image once = draw(subject, options);
  options.size = picture_size * 2u;
  CHECK(mean_difference(halved(draw(subject, options)), once) < 1);
}

TEST_CASE("outlines are smoothed: most rows pass through a colour between backdrop and body", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0.2, 0, 0}, {0.0, 0.0, 0.0});
  const Image image = draw(subject), empty = draw({});
  int rows = 0, smooth_rows = 0;
  for (std::size_t y = 0; y < picture_size.y; ++y) {
    const std::size_t row = 3 * y * picture_size.x;
    const auto darkened = [&](std::size_t x) { return empty.pixels[row + 3 * x] - image.pixels[row + 3 * x]; };
    std::size_t x = 0;
    while (x + 3 < picture_size.x && darkened(x) <= 2) ++x;
    if (x + 3 == picture_size.x) continue;
    ++rows;
    smooth_rows += darkened(x) < darkened(x + 2) * 3 / 4;
  }
  REQUIRE(rows > 40);
  CHECK(smooth_rows > rows / 2);
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

TEST_CASE("an observer hears each pass once, in the order in which they are queued", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0, 0, 0});
  gl::Buffer positions(subject.world.size() * sizeof(glm::vec4), "positions");
  FrameRenderer renderer(subject.model, without_ground());
  std::vector<std::string> passes;
  renderer.draw(positions.id(), 0, [&](const char* pass) { passes.emplace_back(pass); });
  CHECK(passes == std::vector<std::string>{"normals", "shadow", "ground", "seen", "occlusion", "shading"});
}

TEST_CASE("with colours of deformation a body at rest has the scale's first colour all over, wherever it is", "[gl]") {
  const gl::Context context(0);
  RenderOptions deformation = without_ground();
  deformation.coloring = Coloring::deformation;
  const glm::dvec3 first_of_viridis(0.267, 0.005, 0.329);
  const Image expected = draw(sphere({0.5, 0.2, -1}, linear(first_of_viridis)));
  CHECK(largest_difference(draw(sphere({0.5, 0.2, -1}), deformation), expected) <= 6);
}

TEST_CASE("with colours of deformation a body stretched by 30 % everywhere has the scale's last colour", "[gl]") {
  const gl::Context context(0);
  RenderOptions deformation = without_ground();
  deformation.coloring = Coloring::deformation;
  const auto stretched = [](Subject subject) {
    for (auto& p : subject.world) p = glm::vec4(glm::vec3(p) * 1.3f, 1.0f);
    return subject;
  };
  const glm::dvec3 last_of_viridis(0.993, 0.906, 0.144);
  const Image expected = draw(stretched(sphere({0, 0, 0}, linear(last_of_viridis))));
  CHECK(largest_difference(draw(stretched(sphere({0, 0, 0})), deformation), expected) <= 12);
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
