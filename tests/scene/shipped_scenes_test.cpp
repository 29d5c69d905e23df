// The scenes that come with the project hold what the paper says of them.
#include "support/shipped_scenes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "bench/contact/apart.hpp"
#include "collision/responses/response.hpp"
#include "device/device.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "simulation/simulation.hpp"
#include "simulation/start_check.hpp"
#include "simulation/time_plan.hpp"

namespace pliant {
namespace {

std::vector<double> stiffnesses(const SceneDescription& scene) {
  std::vector<double> values;
  for (const BodyDescription& body : scene.bodies) values.push_back(body.stiffness);
  return values;
}

}  // namespace

TEST_CASE("every shipped scene builds without a warning, with bodies clear of each other") {
  const std::vector<SceneDescription> scenes = test::load_shipped_scenes();
  REQUIRE(scenes.size() >= 25);
  const auto device = make_cpu_device(2, 32);
  for (const SceneDescription& scene : scenes) {
    CAPTURE(scene.file.string());
    std::vector<std::string> warnings;
    const ModelAndState built = build_model(load_bodies(scene, &warnings), scene.simulation.gravity, scene.grounds);
    CHECK(warnings == std::vector<std::string>{});
    Simulation simulation(*device, built.model, built.state, plan_time(scene, built.model), scene.collision);
    CHECK(simulation.intersections().pairs == 0);
    CHECK_NOTHROW(expect_apart(simulation, built.model, scene.collision, "the scene"));
  }
}

TEST_CASE("in every shipped scene bodies are clear of each other by brute force, too") {
  for (const SceneDescription& scene : test::load_thinned_scenes()) {
    CAPTURE(scene.file.string());
    const ModelAndState built = build_model(load_bodies(scene), scene.simulation.gravity, scene.grounds);
    const std::vector<glm::dvec3> positions = built.state.world_positions(built.model);
    const bench::ApartOracle oracle(built.model);
    CHECK(oracle.pairs_not_apart(positions) == 0);
    CHECK(oracle.vertices_inside_others(positions) == 0);
  }
}

TEST_CASE("the paper's scenes have its stiffness, damping, elasticity, depth and integrator") {
  const std::pair<const char*, std::vector<double>> expected[] = {{"two_spheres", {40, 40}},       {"soft_and_hard", {5, 100}},
                                                                  {"sphere_bunny", {40, 40}},      {"bunny_teapot", {10, 40}},
                                                                  {"three_spheres", {40, 40, 40}}, {"bunnies_undamped", {40, 40}},
                                                                  {"bunnies_overdamped", {40, 40}}};
  for (const auto& [name, values] : expected) {
    CAPTURE(name);
    const SceneDescription scene = test::load_shipped_scene(name);
    CHECK(stiffnesses(scene) == values);
    CHECK(scene.simulation.integrator.value == "cv8");
    CHECK(scene.collision.elasticity == 0.9);
    CHECK(scene.collision.tree.max_depth == 12u);
    CHECK((scene.collision.tree.split == TreeSplit::centre && scene.collision.tree.fan_out == 2u));
    for (const BodyDescription& body : scene.bodies) CHECK(body.vertex_mass == 1);
  }
  for (const BodyDescription& body : test::load_shipped_scene("bunnies_overdamped").bodies) CHECK(body.damping == 2000);
  CHECK(test::load_shipped_scene("bunnies_overdamped").simulation.damping_law == DampingLaw::constant);
  CHECK(test::load_shipped_scene("bunnies_undamped").simulation.damping_law == DampingLaw::none);
  for (const char* name : {"two_spheres", "soft_and_hard", "sphere_bunny", "bunny_teapot", "three_spheres"})
    for (const BodyDescription& body : test::load_shipped_scene(name).bodies) CHECK(body.damping == 1);
}

TEST_CASE("a scene's twin with impulses differs from it by nothing but its response") {
  const auto same = [](const BodyDescription& a, const BodyDescription& b) {
    return a.mesh == b.mesh && a.scale == b.scale && a.position == b.position && a.velocity == b.velocity &&
           a.stiffness == b.stiffness && a.vertex_mass == b.vertex_mass && a.damping == b.damping && a.kind == b.kind;
  };
  for (const char* name : {"two_spheres", "soft_and_hard", "sphere_bunny", "bunny_teapot", "three_spheres"}) {
    CAPTURE(name);
    const SceneDescription scene = test::load_shipped_scene(name),
                           twin = test::load_shipped_scene(std::string(name) + "_impulse");
    CHECK(scene.collision.response.value == "reflect");
    CHECK(twin.collision.response.value == "impulse");
    CHECK(std::ranges::equal(scene.bodies, twin.bodies, same));
    CHECK(scene.simulation.time_step == twin.simulation.time_step);
    CHECK(scene.simulation.integrator.value == twin.simulation.integrator.value);
    CHECK(scene.simulation.duration == twin.simulation.duration);
    CHECK(elasticity_of(scene.collision) == elasticity_of(twin.collision));
    CHECK(damping_law_of(scene) == damping_law_of(twin));
  }
}

}  // namespace pliant
