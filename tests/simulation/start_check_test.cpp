// What contact by impulses needs of the start: bodies out of grounds.
#include "simulation/start_check.hpp"

#include <catch2/catch.hpp>

#include "device/cpu/cpu_device.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "simulation/time_plan.hpp"
#include "support/expect_error.hpp"

namespace pliant {
namespace {

// A sphere of radius 1 at the origin, named "ball".
const std::string ball = "[[body]]\nname = \"ball\"\nmesh = \"icosphere:2\"\n";

class Start {
 public:
  explicit Start(const std::string& text)
      : scene_(parse_scene(text, "scene.toml", {})),
        start_(build_model(load_bodies(scene_), scene_.simulation.gravity, scene_.grounds)) {}

  Error error() {
    const auto device = make_cpu_device(1, 32);
    Simulation simulation(*device, start_.model, start_.state, plan_time(scene_, start_.model), scene_.collision);
    return error_of([&] { expect_apart(simulation, start_.model, "scene.toml"); });
  }

 private:
  SceneDescription scene_;
  ModelAndState start_;
};

TEST_CASE("a body in a ground is told the way out of that ground, whose line is named") {
  const Error below = Start("[[ground]]\nheight = -5\n[[ground]]\npoint = [0, 0.5, 0]\nnormal = [0, -2, 0]\n" + ball).error();
  CHECK(below.kind() == ErrorKind::input);
  check_says(below, {"scene.toml:3: ground: body \"ball\" stands 0.5 m deep", "move the body by [0, -0.51", "move the ground"});
  check_says(Start("[[ground]]\nheight = -1\n" + ball).error(), {"scene.toml:1: ground: body \"ball\" touches this ground"});
}

TEST_CASE("a body that no single move brings out of grounds is promised none") {
  const std::string floor = "[[ground]]\nheight = -0.5\n", ceiling = "[[ground]]\npoint = [0, 0.75, 0]\nnormal = [0, -1, 0]\n";
  const Error in_both = Start(floor + ceiling + ball).error();
  check_says(in_both, {"scene.toml:1: ground", "stands 0.5 m deep in this ground, and stands 0.25 m deep in that of scene.toml:3",
                       "out of every ground"});
  CHECK(std::string(in_both.what()).find("move the body by") == std::string::npos);
  const Error out_of_one = Start(floor + "[[ground]]\npoint = [0, 1.25, 0]\nnormal = [0, -1, 0]\n" + ball).error();
  check_says(out_of_one, {"scene.toml:1: ground", "out of every ground"});
  CHECK(std::string(out_of_one.what()).find("move the body by") == std::string::npos);
}

}  // namespace
}  // namespace pliant
