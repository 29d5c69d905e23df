// Pictures of spheres, against what geometry says must be in them.
#include "render/frame_renderer.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>

#include "gl/context.hpp"
#include "gl/objects.hpp"
#include "mesh/generators.hpp"

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

int largest_difference(const Image& a, const Image& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  int largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) largest = std::max(largest, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
  return largest;
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

TEST_CASE("a picture is drawn anew for every draw and camera", "[gl]") {
  const gl::Context context(0);
  const Subject subject = sphere({0, 0, 0});
  gl::Buffer positions(subject.world.size() * sizeof(glm::vec4), "positions");
  positions.write(0, std::as_bytes(std::span(subject.world)));
  FrameRenderer renderer(subject.model, without_ground());
  renderer.draw(positions.id(), 0);
  const Image first = renderer.read();
  renderer.set_camera({{3, 1, 9}, {0, 0, 0}, 40});
  renderer.draw(positions.id(), 0);
  CHECK(renderer.read().pixels != first.pixels);
  renderer.set_camera(front);
  renderer.draw(positions.id(), 0);
  CHECK(renderer.read().pixels == first.pixels);
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
