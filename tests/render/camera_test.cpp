// Cameras that frame a box.
#include "render/camera.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "render/frame_renderer.hpp"

using namespace pliant;
using namespace pliant::render;

namespace {

/// Normalised picture coordinates, -1 to 1, with the depth as z.
glm::dvec3 project(const glm::dmat4& to_clip, const glm::dvec3& p) {
  const glm::dvec4 clip = to_clip * glm::dvec4(p, 1);
  return glm::dvec3(clip) / clip.w;
}

}  // namespace

TEST_CASE("a framed box is inside the picture, with a margin, and fills most of its width or height") {
  for (const glm::dvec3 half :
       {glm::dvec3(1), glm::dvec3(5, 1, 1), glm::dvec3(0.1, 4, 0.1), glm::dvec3(0, 0, 3), glm::dvec3(1e-6)}) {
    for (const double aspect : {16.0 / 9.0, 1.0, 0.5}) {
      const glm::dvec3 centre(3, -2, 7);
      const SceneBox box{centre - half, centre + half};
      const glm::dmat4 to_clip = view_projection(frame_scene(box, aspect), aspect);
      double reach = 0;
      for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 side(i & 1u ? 1 : -1, i & 2u ? 1 : -1, i & 4u ? 1 : -1);
        const glm::dvec3 p = project(to_clip, centre + side * half);
        CHECK(std::abs(p.z) < 1);
        reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
      }
      INFO(half.x << ' ' << half.y << ' ' << half.z << " aspect " << aspect);
      CHECK(reach < 0.95);
      CHECK(reach > 0.9);
    }
  }
}

TEST_CASE("a box that is a point still has a camera and a ground") {
  const SceneBox box{glm::dvec3(1, 2, 3), glm::dvec3(1, 2, 3)};
  const CameraDescription camera = frame_scene(box, 1.5);
  CHECK(glm::distance(camera.eye, camera.target) > 0);
  CHECK(ground_below(box) < 2);
  CHECK(std::isfinite(view_projection(camera, 1.5)[0][0]));
}

TEST_CASE("the camera's target is the picture's middle, up is up and right is right") {
  const CameraDescription camera{{0, 2, 6}, {0, 0, 0}, 40};
  const glm::dmat4 to_clip = view_projection(camera, 1.5);
  CHECK(glm::length(glm::dvec2(project(to_clip, camera.target))) < 1e-12);
  CHECK(project(to_clip, {0, 1, 0}).y > 0);
  CHECK(project(to_clip, {1, 0, 0}).x > 0);
  // At the target's distance the picture is 2 d tan(fov / 2) high.
  const double half_height = std::sqrt(40.0) * std::tan(glm::radians(20.0));
  CHECK(project(to_clip, {1.5 * half_height, 0, 0}).x == Approx(1.0));
}

TEST_CASE("a camera that looks straight down has a picture") {
  const glm::dmat4 to_clip = view_projection({{0, 5, 0}, {0, 0, 0}, 40}, 1.0);
  CHECK(project(to_clip, {1, 0, 0}).x > 0.1);
  CHECK(project(to_clip, {0, 0, -1}).y > 0.1);
}

TEST_CASE("a box is framed from any side, without turning the camera") {
  const SceneBox box{{-2, 0, 1}, {3, 1, 7}};
  for (const glm::dvec3 side : {glm::dvec3(1, 0, 0), glm::dvec3(0.1, -2, 0.3), glm::dvec3(0, 1, 0), glm::dvec3(-1, 1, -1)}) {
    const glm::dvec3 back = glm::normalize(side);
    const CameraDescription camera = frame_from(back, box, 1.5, 50);
    CHECK(glm::distance(axes_of(camera).back, back) < 1e-12);
    CHECK(camera.field_of_view == 50);
    const glm::dmat4 to_clip = view_projection(camera, 1.5);
    for (unsigned i = 0; i < 8; ++i) {
      const glm::dvec3 p = project(to_clip, {i & 1u ? 3 : -2, i & 2u ? 1 : 0, i & 4u ? 7 : 1});
      CHECK(std::max(std::abs(p.x), std::abs(p.y)) < 0.95);
    }
  }
}

TEST_CASE("a box around places holds those that are finite, and touches them on every side") {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const glm::dvec3 places[] = {{1, 5, -3}, {nan, 0, 0}, {-2, 4, 9}, {0, infinity, 0}, {0, 0, -infinity}};
  const SceneBox box = box_around(places);
  CHECK(box.low == glm::dvec3(-2, 4, -3));
  CHECK(box.high == glm::dvec3(1, 5, 9));
  CHECK(box_around({}).radius() > 0);
}

TEST_CASE("a camera's axes are those of its picture") {
  for (const glm::dvec3 eye : {glm::dvec3(0, 2, 6), glm::dvec3(0, 5, 0), glm::dvec3(-3, -1, 0.5)}) {
    const CameraDescription camera{eye, {0, 0, 0}, 40};
    const glm::dmat4 to_clip = view_projection(camera, 1.0);
    const CameraAxes axes = axes_of(camera);
    CHECK(project(to_clip, axes.right * 0.1).x > 0.01);
    CHECK(std::abs(project(to_clip, axes.right * 0.1).y) < 1e-12);
    CHECK(project(to_clip, axes.up * 0.1).y > 0.01);
    CHECK(std::abs(project(to_clip, axes.up * 0.1).x) < 1e-12);
    CHECK(project(to_clip, axes.back * 0.1).z < project(to_clip, {0, 0, 0}).z);
  }
}

TEST_CASE("a picture has its scene's size, camera, colouring and ground, or ones that fit its box") {
  const SceneBox box{{-1, 2, -1}, {1, 4, 1}};
  const RenderOptions fitted = options_for(box, {});
  CHECK(fitted.ground_height == ground_below(box));
  CHECK(fitted.camera.target == frame_scene(box, 16.0 / 9).target);
  OutputDescription asked;
  asked.size = {64, 48};
  asked.camera = CameraDescription{{7, 8, 9}, {1, 2, 3}, 50};
  asked.coloring = Coloring::deformation;
  asked.ground_height = -5;
  const RenderOptions given = options_for(box, asked);
  CHECK(given.size == asked.size);
  CHECK(given.camera.eye == glm::dvec3(7, 8, 9));
  CHECK(given.coloring == Coloring::deformation);
  CHECK(given.ground_height == -5.0);
}
