// What a mouse does to a camera.
#include "view/orbit.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

using namespace pliant;
using namespace pliant::view;

namespace {

const glm::dvec2 window_size{1200, 800};
const CameraDescription camera{{1, 2, 6}, {0.5, -0.25, 1}, 40};

/// Where a place in the world is in the picture [pixels from the top left].
glm::dvec2 pixel_of(const CameraDescription& seen_by, const glm::dvec3& place) {
  const glm::dvec4 clip = render::view_projection(seen_by, window_size.x / window_size.y) * glm::dvec4(place, 1);
  return {(clip.x / clip.w + 1) / 2 * window_size.x, (1 - clip.y / clip.w) / 2 * window_size.y};
}

double distance_of(const CameraDescription& c) { return glm::distance(c.eye, c.target); }

TEST_CASE("a drag over the window's width turns the camera once around") {
  const CameraDescription turned = orbit(camera, {0, 300}, {1200, 300}, window_size);
  CHECK(glm::distance(turned.eye, camera.eye) < 1e-12 * distance_of(camera));
  const CameraDescription half = orbit(camera, {100, 300}, {700, 300}, window_size);
  CHECK(half.eye.y == Approx(camera.eye.y));
  const glm::dvec3 before = camera.eye - camera.target, after = half.eye - half.target;
  CHECK(after.x == Approx(-before.x));
  CHECK(after.z == Approx(-before.z));
}

TEST_CASE("a camera that orbits keeps its target and its distance") {
  CameraDescription c = camera;
  for (int k = 0; k < 500; ++k) {
    c = orbit(c, {0, 0}, {13.0 * std::sin(k), 17.0 * std::cos(3 * k)}, window_size);
    CHECK(c.target == camera.target);
    CHECK(distance_of(c) == Approx(distance_of(camera)).epsilon(1e-9));
  }
}

TEST_CASE("the near side of the scene follows the mouse") {
  const glm::dvec3 near = camera.target + glm::normalize(camera.eye - camera.target) * 0.5;
  const glm::dvec2 before = pixel_of(camera, near);
  CHECK(pixel_of(orbit(camera, {600, 400}, {610, 400}, window_size), near).x > before.x + 1);
  CHECK(pixel_of(orbit(camera, {600, 400}, {600, 410}, window_size), near).y > before.y + 1);
}

TEST_CASE("no drag takes a camera over a pole, and it comes back from there") {
  for (const double way : {1.0, -1.0}) {
    const CameraDescription high = orbit(camera, {0, 0}, {0, way * 5000}, window_size);
    CHECK(way * (high.eye.y - high.target.y) > 0.99 * distance_of(high));
    CHECK(render::axes_of(high).up.y > 0);
    const CameraDescription back = orbit(high, {0, 0}, {0, -way * 200}, window_size);
    CHECK(std::abs(back.eye.y - back.target.y) < 0.9 * distance_of(back));
  }
}

TEST_CASE("a camera straight above can be dragged") {
  const CameraDescription turned = orbit({{0, 5, 0}, {0, 0, 0}, 40}, {0, 0}, {10, -100}, window_size);
  CHECK(std::isfinite(turned.eye.x + turned.eye.y + turned.eye.z));
  CHECK(turned.eye.y < 5);
  CHECK(distance_of(turned) == Approx(5));
}

TEST_CASE("a camera near straight above does not jump when it is touched") {
  const CameraDescription steep{{0, 5, 0.05}, {0, 0, 0}, 40};
  CHECK(glm::distance(orbit(steep, {0, 0}, {0, 1e-6}, window_size).eye, steep.eye) < 1e-6);
}

TEST_CASE("panning keeps the picked point under the cursor") {
  const glm::dvec3 picked = camera.target + render::axes_of(camera).right * 0.7 + render::axes_of(camera).up * 0.4;
  const glm::dvec2 from = pixel_of(camera, picked), to = from + glm::dvec2(-230, 95);
  const CameraDescription shifted = pan(camera, from, to, window_size);
  CHECK(glm::distance(pixel_of(shifted, picked), to) < 1e-9);
  CHECK(glm::distance(shifted.eye - shifted.target, camera.eye - camera.target) < 1e-12);
}

TEST_CASE("zooming keeps the target and the direction, and back again is where it began") {
  const CameraDescription nearer = zoom(camera, 3);
  CHECK(nearer.target == camera.target);
  CHECK(distance_of(nearer) == Approx(0.729 * distance_of(camera)));
  CHECK(glm::distance(render::axes_of(nearer).back, render::axes_of(camera).back) < 1e-12);
  CHECK(glm::distance(zoom(nearer, -3).eye, camera.eye) < 1e-12);
  CHECK(distance_of(zoom(camera, 1e6)) > 0);
  CHECK(std::isfinite(distance_of(zoom(camera, -1e6))));
}

TEST_CASE("framing shows the whole box, from where the camera looks") {
  const render::SceneBox box{{-7, 1, 2}, {-3, 2, 9}};
  const CameraDescription framed = frame(camera, box, window_size);
  CHECK(glm::distance(render::axes_of(framed).back, render::axes_of(camera).back) < 1e-12);
  for (unsigned i = 0; i < 8; ++i) {
    const glm::dvec2 pixel = pixel_of(framed, {i & 1u ? -3 : -7, i & 2u ? 2 : 1, i & 4u ? 9 : 2});
    CHECK(pixel.x > 0);
    CHECK(pixel.x < window_size.x);
    CHECK(pixel.y > 0);
    CHECK(pixel.y < window_size.y);
  }
}

}  // namespace
