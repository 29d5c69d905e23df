// This computes the picture's geometry without the renderer's matrices.
#include "render/sphere_pictures.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "gl/objects.hpp"
#include "mesh/generators.hpp"

namespace pliant::test {

using namespace render;

Subject sphere(const glm::dvec3& centre, const glm::dvec3& color, const char* generator) {
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

Subject together(Subject a, const Subject& b) {
  const auto first = static_cast<std::uint32_t>(a.world.size()), triangles = static_cast<std::uint32_t>(a.model.triangles.size());
  const auto first_body = static_cast<float>(a.model.bodies.size());
  for (const auto& [i, j, k] : b.model.triangles) a.model.triangles.push_back({first + i, first + j, first + k});
  for (const glm::vec4& p : b.model.rest_positions) a.model.rest_positions.emplace_back(glm::vec3(p), first_body + p.w);
  for (ModelBody body : b.model.bodies) {
    body.first_vertex += first;
    body.first_triangle += triangles;
    a.model.bodies.push_back(body);
  }
  a.world.insert(a.world.end(), b.world.begin(), b.world.end());
  return a;
}

Subject scaled(Subject subject, float factor) {
  glm::vec3 middle(0);
  for (const glm::vec4& p : subject.world) middle += glm::vec3(p) / static_cast<float>(subject.world.size());
  for (glm::vec4& p : subject.world) p = glm::vec4(middle + factor * (glm::vec3(p) - middle), 1.0f);
  return subject;
}

std::vector<glm::dvec3> places_seen() {
  std::vector<glm::dvec3> places = generate_mesh("icosphere:4").positions;
  std::erase_if(places, [](const glm::dvec3& p) { return glm::dot(p, glm::normalize(front.eye - p)) < 0.25; });
  return places;
}

RenderOptions without_ground() {
  RenderOptions options;
  options.size = picture_size;
  options.camera = front;
  options.scene = {{-2, -2, -2}, {2, 2, 2}};
  return options;
}

Drawing::Drawing(const Subject& subject, const RenderOptions& options)
    : positions(subject.world.size() * sizeof(glm::vec4), "positions"), renderer(subject.model, options) {
  positions.write(0, std::as_bytes(std::span(subject.world)));
}

Image Drawing::picture() {
  renderer.draw(positions.id(), 0);
  return renderer.read();
}

Image draw(const Subject& subject, const RenderOptions& options) { return Drawing(subject, options).picture(); }

Silhouette::Silhouette(const Image& image, const RenderOptions& options) : covered(std::size_t{image.width} * image.height) {
  const Image empty = draw({}, options);
  REQUIRE(empty.pixels.size() == image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (image.pixels[i] != empty.pixels[i]) covered[i / 3] = true;
  }
}

bool Silhouette::at(int x, int y) const {
  const int width = static_cast<int>(picture_size.x), height = static_cast<int>(picture_size.y);
  return x >= 0 && y >= 0 && x < width && y < height && covered[static_cast<std::size_t>(y * width + x)];
}

bool Silhouette::near(int x, int y) const {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (at(x + dx, y + dy)) return true;
    }
  }
  return false;
}

long Silhouette::area() const { return std::ranges::count(covered, true); }

void PixelBox::add(double x, double y) {
  left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
}

PixelBox box_of(const Silhouette& silhouette) {
  PixelBox box;
  for (int y = 0; y < static_cast<int>(picture_size.y); ++y) {
    for (int x = 0; x < static_cast<int>(picture_size.x); ++x) {
      if (silhouette.at(x, y)) box.add(x, y), box.add(x + 1, y + 1);
    }
  }
  return box;
}

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

glm::ivec2 pixel_of(const glm::dvec3& place, const CameraDescription& camera) {
  const PixelBox at = pinhole_box({glm::vec4(place, 1)}, camera);
  return {at.left, at.top};
}

int brightness(const Image& image, const glm::ivec2& pixel) {
  const std::size_t first =
      std::size_t{3} * (static_cast<std::size_t>(pixel.y) * image.width + static_cast<std::size_t>(pixel.x));
  return image.pixels[first] + image.pixels[first + 1] + image.pixels[first + 2];
}

int brightness_at(const Image& image, const glm::dvec3& place, const CameraDescription& camera) {
  return brightness(image, pixel_of(place, camera));
}

GroundChange change_of_ground(const Subject& subject, const RenderOptions& with_ground) {
  RenderOptions floating = with_ground;
  floating.ground_height.reset();
  const Image image = draw(subject, with_ground), empty = draw({}, with_ground);
  const Silhouette body{draw(subject, floating), floating};
  GroundChange change;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (body.near(static_cast<int>(i / 3 % picture_size.x), static_cast<int>(i / 3 / picture_size.x))) continue;
    const int darker = empty.pixels[i] - image.pixels[i];
    change.darkest = std::max(change.darkest, darker);
    change.brightest = std::max(change.brightest, -darker);
    change.sum += darker;
  }
  return change;
}

}  // namespace pliant::test
