// Spheres before a camera, their pictures, and what geometry says of them.
#pragma once
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "gl/objects.hpp"
#include "model/model.hpp"
#include "render/frame_renderer.hpp"

namespace pliant::test {

inline constexpr glm::uvec2 picture_size{320, 180};
inline const CameraDescription front{{0, 1, 7}, {0, 0, 0}, 40};
/// Unit vector towards the key light of renderers that are made with the camera `front`. The light stands behind the camera's
/// left shoulder.
inline const glm::dvec3 to_light = glm::normalize(glm::dvec3(-0.55, 1.15, 0.55));

/// Bodies, and where their vertices are.
struct Subject {
  Model model;
  std::vector<glm::vec4> world;  // [m]
};

[[nodiscard]] Subject sphere(const glm::dvec3& centre, const glm::dvec3& color = {0.8, 0.1, 0.05},
                             const char* generator = "icosphere:3");
/// Returns a subject with the bodies of both.
[[nodiscard]] Subject together(Subject a, const Subject& b);
/// Scales a subject about the mean of its vertices.
[[nodiscard]] Subject scaled(Subject subject, float factor);
/// Places all over the part of a unit sphere about the origin that `front` sees, but for its rim. A place is also its own normal.
[[nodiscard]] std::vector<glm::dvec3> places_seen();

[[nodiscard]] render::RenderOptions without_ground();
/// A subject to be drawn more than once. Needs a current context while it lives.
struct Drawing {
  explicit Drawing(const Subject& subject, const render::RenderOptions& options = without_ground());
  [[nodiscard]] render::Image picture();

  gl::Buffer positions;
  render::FrameRenderer renderer;
};
/// Needs a current context.
[[nodiscard]] render::Image draw(const Subject& subject, const render::RenderOptions& options = without_ground());

/// Pixels that differ from the picture without bodies.
struct Silhouette {
  explicit Silhouette(const render::Image& image, const render::RenderOptions& options = without_ground());
  [[nodiscard]] bool at(int x, int y) const;
  [[nodiscard]] bool near(int x, int y) const;
  [[nodiscard]] long area() const;

  std::vector<bool> covered;
};

struct PixelBox {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
  void add(double x, double y);
};

[[nodiscard]] PixelBox box_of(const Silhouette& silhouette);
/// Where a pinhole camera sees the vertices, by similar triangles.
[[nodiscard]] PixelBox pinhole_box(const std::vector<glm::vec4>& world, const CameraDescription& camera);
/// The pixel in which a camera sees a place, counted from the top left.
[[nodiscard]] glm::ivec2 pixel_of(const glm::dvec3& place, const CameraDescription& camera = front);
/// Sum of a pixel's red, green and blue.
[[nodiscard]] int brightness(const render::Image& image, const glm::ivec2& pixel);
/// The brightness of the pixel in which a camera sees a place.
[[nodiscard]] int brightness_at(const render::Image& image, const glm::dvec3& place, const CameraDescription& camera = front);

/// By how much a body changes the ground beside it, of 255.
struct GroundChange {
  int darkest = 0, brightest = 0;  // the largest changes of any channel of any pixel
  double sum = 0;                  // of all changes, which are positive where the ground is darker
};

[[nodiscard]] GroundChange change_of_ground(const Subject& subject, const render::RenderOptions& with_ground);

}  // namespace pliant::test
