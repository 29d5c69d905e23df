// The scenes that come with the project hold what the paper says of them.
#include "support/shipped_scenes.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <glm/vector_relational.hpp>

#include "mesh/report.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"

namespace pliant {
namespace {

std::vector<double> stiffnesses(const SceneDescription& scene) {
  std::vector<double> values;
  for (const BodyDescription& body : scene.bodies) values.push_back(body.stiffness);
  return values;
}

/// One body's bounding box in the world at the start.
std::pair<glm::dvec3, glm::dvec3> box(const ModelAndState& built, const ModelBody& body) {
  const std::vector<glm::dvec3> world = built.state.world_positions(built.model);
  TriangleMesh mesh;
  mesh.positions.assign(world.begin() + body.first_vertex, world.begin() + body.first_vertex + body.vertex_count);
  const MeshReport report = report_mesh(mesh);
  return {report.lowest, report.highest};
}

}  // namespace

TEST_CASE("every shipped scene builds without a warning, with bodies clear of each other") {
  const std::vector<SceneDescription> scenes = test::load_shipped_scenes();
  REQUIRE(scenes.size() >= 7);
  for (const SceneDescription& scene : scenes) {
    CAPTURE(scene.file.string());
    std::vector<std::string> warnings;
    const ModelAndState built = build_model(load_bodies(scene, &warnings), scene.simulation.gravity);
    CHECK(warnings == std::vector<std::string>{});
    for (std::size_t i = 0; i < built.model.bodies.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto [low_i, high_i] = box(built, built.model.bodies[i]);
        const auto [low_j, high_j] = box(built, built.model.bodies[j]);
        CHECK((glm::any(glm::lessThan(high_i, low_j)) || glm::any(glm::lessThan(high_j, low_i))));
      }
    }
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
    for (const BodyDescription& body : scene.bodies) CHECK(body.vertex_mass == 1);
  }
  for (const BodyDescription& body : test::load_shipped_scene("bunnies_overdamped").bodies) CHECK(body.damping == 2000);
  CHECK(test::load_shipped_scene("bunnies_overdamped").simulation.damping_law == DampingLaw::constant);
  CHECK(test::load_shipped_scene("bunnies_undamped").simulation.damping_law == DampingLaw::none);
  for (const char* name : {"two_spheres", "soft_and_hard", "sphere_bunny", "bunny_teapot", "three_spheres"})
    for (const BodyDescription& body : test::load_shipped_scene(name).bodies) CHECK(body.damping == 1);
}

}  // namespace pliant
