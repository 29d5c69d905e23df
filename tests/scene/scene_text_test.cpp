// Scenes that are written as text and read again.
#include "scene/scene_text.hpp"

#include <algorithm>
#include <fstream>

#include "support/scene_text.hpp"
#include "support/shipped_scenes.hpp"

namespace pliant {
namespace {

void check_same(const SimulationDescription& a, const SimulationDescription& b) {
  CHECK(a.integrator.value == b.integrator.value);
  CHECK((a.time_step == b.time_step && a.tolerance == b.tolerance && a.duration == b.duration));
  CHECK((a.damping_law == b.damping_law && a.gravity == b.gravity && a.sleep == b.sleep));
}

void check_same(const CollisionDescription& a, const CollisionDescription& b) {
  CHECK(a.response.value == b.response.value);
  CHECK((a.elasticity == b.elasticity && a.friction == b.friction && a.restitution == b.restitution && a.gap == b.gap));
  CHECK((a.search == b.search && a.triangle_test == b.triangle_test && a.tree == b.tree));
}

void check_same(const BodyDescription& a, const BodyDescription& b) {
  CHECK((a.name == b.name && a.kind == b.kind && a.is_container == b.is_container));
  CHECK((a.mesh == b.mesh && a.weld == b.weld && a.scale == b.scale));
  CHECK((a.subdivide == b.subdivide && a.subdivision == b.subdivision));
  CHECK((a.position == b.position && a.rotation == b.rotation && a.velocity == b.velocity && a.spin == b.spin));
  CHECK((a.path == b.path && a.repeats == b.repeats && a.stretch == b.stretch));
  CHECK((a.stiffness == b.stiffness && a.total_stiffness == b.total_stiffness));
  CHECK((a.forces == b.forces && a.force_tolerance == b.force_tolerance));
  CHECK((a.vertex_mass == b.vertex_mass && a.total_mass == b.total_mass && a.damping == b.damping));
  CHECK((a.surface == b.surface && a.restitution == b.restitution && a.self_contact == b.self_contact));
  CHECK((a.pressure == b.pressure && a.pressure_law == b.pressure_law && a.color == b.color));
}

void check_same(const SceneDescription& a, const SceneDescription& b) {
  CHECK((a.title == b.title && a.about == b.about && a.output == b.output));
  check_same(a.simulation, b.simulation);
  check_same(a.collision, b.collision);
  REQUIRE(a.bodies.size() == b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) check_same(a.bodies[i], b.bodies[i]);
  REQUIRE(a.grounds.size() == b.grounds.size());
  for (std::size_t i = 0; i < a.grounds.size(); ++i) {
    CHECK((a.grounds[i].point == b.grounds[i].point && a.grounds[i].normal == b.grounds[i].normal));
    CHECK(a.grounds[i].surface == b.grounds[i].surface);
  }
}

void check_round_trip(const SceneDescription& scene) {
  const std::string text = scene_text(scene, scene.file.parent_path());
  CAPTURE(text);
  check_same(parse_scene(text, scene.file), scene);
}

TEST_CASE("every key that is written is read again as it was") {
  check_round_trip(load_text(R"(
title = "All \"keys\" \\ with signs"
about = "What there is"
[simulation]
integrator = "cv8"
time_step = 0.1
duration = 1e-30
damping_law = "constant"
gravity = [1, -9.81, 1e8]
sleep = true
[collision]
response = "impulse"
elasticity = 1
friction = 0.3333333333333333
restitution = 0.25
gap = 0.02
search = "brute_force"
triangle_test = "moller"
tree = { split = "centre", fan_out = 4, refit = "hybrid", max_depth = 12, leaf_size = 7 }
[output]
frame_rate = 24
size = [640, 480]
camera = { eye = [0, 2, 6], target = [1, 0, 0], field_of_view = 50 }
coloring = "deformation"
marks = "contacts"
ground_height = -1.5
[[ground]]
point = [0, 0, -3]
normal = [0, 0, 1]
elasticity = 0.1
friction = 0.2
gap = 0.03
[[body]]
mesh = "thing.obj"
weld = 1e-6
subdivide = 3
subdivision = "loop"
scale = 2
position = [1, 2, 3]
rotation = [4, 5, 6]
velocity = [7, 8, 9]
spin = [1.5, 2.5, 3.5]
stretch = [0.5, 1, 2]
total_stiffness = 1000
forces = "clustered"
force_tolerance = 2e-3
total_mass = 10
damping = 0
elasticity = 0.4
friction = 2
gap = 0.01
restitution = 0.6
self_contact = true
pressure = 2.5
pressure_law = "constant"
color = [0.1, 0.2, 0.3]
[[body]]
name = "second"
mesh = "icosphere:1"
stiffness = 7
vertex_mass = 3
[[body]]
kind = "static"
mesh = "cube:2"
[[body]]
kind = "scripted"
mesh = "cube:2"
repeats = true
path = [{ time = 0 }, { time = 0.3, position = [1, 0, 0], rotation = [0, 20, 0] }, { time = 1.1, position = [0, 0, 0], rotation = [0, 360, 0] }]
[[container]]
name = "crate"
size = [2, 0.1, 3]
open = true
spin = [0, 1, 0]
friction = 0
[[container]]
shape = "sphere"
radius = 2.5
position = [0, 9, 0]
color = [0.5, 0.5, 1]
)"));
  check_round_trip(load_text("[simulation]\ntolerance = 1e-5\n[[ground]]\nheight = -0.5\n" + smallest));
}

TEST_CASE("every shipped scene is written so that it is read as the same") {
  for (const SceneDescription& scene : test::load_shipped_scenes()) {
    CAPTURE(scene.file.string());
    check_round_trip(scene);
  }
}

TEST_CASE("a scene for another folder names the same meshes") {
  const test::ScratchFolder folder;
  std::filesystem::create_directories(folder.path / "scenes");
  std::filesystem::create_directories(folder.path / "saved here");
  const SceneDescription scene = parse_scene("[[body]]\nmesh = \"../thing.obj\"\n" + smallest, folder.path / "scenes/a.toml");
  const auto file = folder.path / "saved here" / "b.toml";
  const SceneDescription moved = parse_scene(scene_text(scene, file.parent_path()), file);
  CHECK(std::filesystem::weakly_canonical(file.parent_path() / moved.bodies.at(0).mesh) ==
        std::filesystem::weakly_canonical(folder.path / "thing.obj"));
  CHECK(moved.bodies.at(1).mesh == "icosphere:1");
}

TEST_CASE("a scene whose numbers no file may have can't be read again") {
  SceneDescription scene = load_text(smallest);
  scene.bodies[0].velocity.x = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(parse_scene(scene_text(scene, {}), "saved.toml"), Catch::Contains("velocity"));
}

}  // namespace
}  // namespace pliant
