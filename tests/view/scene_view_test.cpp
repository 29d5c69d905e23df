// Pictures of a session, without a window.
#include "view/scene_view.hpp"

#include <array>
#include <catch2/catch.hpp>

#include "device/gpu/gpu_device.hpp"
#include "gl/context.hpp"
#include "support/collision_scene.hpp"
#include "support/has.hpp"
#include "support/pictures.hpp"

using namespace pliant;
using namespace pliant::view;

namespace {

LoadedScene overlapping_spheres() {
  LoadedScene scene;
  scene.description.simulation.time_step = 0.01;
  scene.start = build_model(colliding_spheres(), {0, 0, 0});
  return scene;
}

/// What a view of its own draws of the session.
render::Image picture_of(Session& session, const Shows& shows) {
  constexpr glm::uvec2 size(160, 120);
  SceneView view(session, size, render::Detail::full);
  view.draw({.step = session.step(), .camera = view.first_camera(), .size = size, .shows = shows});
  return view.picture();
}

TEST_CASE("a session looks the same on every device, whatever its bodies are coloured by", "[gl]") {
  if (test::lacks_gl()) return;
  gl::Context context(0);
  const auto cpu = make_cpu_device(2, 32), gpu = make_gpu_device(context);
  Session session(*cpu, overlapping_spheres());
  for (int k = 0; k < 7; ++k) session.step_once();  // an odd number: positions are in the other half
  std::array<Shows, 4> looks;
  looks[1].colors = Colors::deformation;
  looks[2].colors = Colors::speed;
  looks[3].wireframe = true;
  std::vector<render::Image> pictures;
  for (const Shows& shows : looks) pictures.push_back(picture_of(session, shows));
  for (std::size_t k = 1; k < pictures.size(); ++k) CHECK_FALSE(are_alike(pictures[k], pictures[0]));
  session.move_to(*gpu);
  for (std::size_t k = 0; k < pictures.size(); ++k) CHECK(are_alike(picture_of(session, looks[k]), pictures[k]));
}

TEST_CASE("a view follows its session, and draws no picture twice", "[gl]") {
  if (test::lacks_gl()) return;
  gl::Context context(0);
  const auto cpu = make_cpu_device(2, 32), gpu = make_gpu_device(context);
  Session session(*cpu, overlapping_spheres());
  SceneView view(session, {160, 120}, render::Detail::reduced);
  Look look{.step = 0, .camera = view.first_camera(), .size = {160, 120}, .shows = {}};
  view.draw(look);
  const render::Image start = view.picture();
  for (int k = 0; k < 20; ++k) session.step_once();
  view.draw(look);
  CHECK(view.picture().pixels == start.pixels);
  look.step = session.step();
  view.draw(look);
  CHECK_FALSE(are_alike(view.picture(), start));

  session.move_to(*gpu);
  session.restart();
  look.step = 0;
  view.draw(look);
  CHECK(are_alike(view.picture(), start));
  look.size = {100, 120};
  view.draw(look);
  CHECK(view.picture().width == 100);
}

}  // namespace
