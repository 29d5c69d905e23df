// Scenes that are saved while they play, and opened again.
#include "view/present_scene.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <glm/geometric.hpp>

#include "mesh/generators.hpp"
#include "model/body_motion.hpp"
#include "scene/scene_text.hpp"
#include "support/scratch.hpp"

using namespace pliant;
using namespace pliant::view;

namespace {

// A stretched ball and balls in rows that fly and spin over a ground, beside a box, a turning mill and a door.
constexpr const char* varied =
    "[simulation]\nintegrator = \"verlet\"\ntime_step = 0.005\ngravity = [0, -9.81, 0]\n"
    "[[ground]]\nheight = -3\n"
    "[[body]]\nname = \"ball\"\nmesh = \"ball.obj\"\nposition = [0, 2, 0]\nrotation = [10, 20, 30]\nvelocity = [1, 2, 0]\n"
    "spin = [0, 3, 1]\nstretch = [0.9, 1, 1]\ntotal_mass = 1\ntotal_stiffness = 2000\nfriction = 0.25\n"
    "[[body]]\nname = \"row\"\nmesh = \"icosphere:1\"\nscale = 0.2\ncount = [2, 1, 1]\nspacing = [1, 0, 0]\n"
    "position = [3, 2, 0]\nspin = [0, 0, 2]\ntotal_mass = 1\ntotal_stiffness = 2000\n"
    "[[body]]\nname = \"block\"\nkind = \"static\"\nmesh = \"cube:2\"\nposition = [-5, 0, 0]\nrestitution = 0.5\n"
    "[[body]]\nname = \"mill\"\nkind = \"scripted\"\nmesh = \"cube:2\"\nposition = [-8, 0, 0]\nvelocity = [0, 0, 1]\nspin = [0, "
    "2, 0]\n"
    "[[body]]\nname = \"door\"\nkind = \"scripted\"\nmesh = \"cube:2\"\nposition = [-11, 0, 0]\n"
    "path = [{ time = 0 }, { time = 0.1, position = [0, 1, 0] }, { time = 1, position = [0, 2, 0], rotation = [0, 45, 0] }]\n"
    "[[container]]\nsize = [2, 2, 2]\nposition = [9, 0, 0]\nopen = true\n";

LoadedScene load_varied(const test::ScratchFolder& folder) {
  const TriangleMesh mesh = generate_mesh("icosphere:1");
  std::ofstream obj(folder.path / "ball.obj");
  for (const glm::dvec3& p : mesh.positions) obj << "v " << 0.3 * p.x + 0.1 << " " << 0.3 * p.y << " " << 0.3 * p.z << "\n";
  for (const auto& [a, b, c] : mesh.triangles) obj << "f " << a + 1 << " " << b + 1 << " " << c + 1 << "\n";
  obj.close();
  std::ofstream(folder.path / "varied.toml") << varied;
  return load(folder.path / "varied.toml");
}

// Writes the scene into another folder, where the mesh is not, and opens it.
LoadedScene saved_and_opened(Session& session, const test::ScratchFolder& folder) {
  const auto file = folder.path / "saved" / "varied.toml";
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << scene_text(present_scene(session), file.parent_path());
  return load(file);
}

BodySetup ball_beside() {
  BodySetup setup{generate_mesh("icosphere:2"), {}};
  BodyDescription& ball = setup.description;
  ball.name = "thrown 1";
  ball.mesh = "icosphere:2";
  ball.scale = 0.2;
  ball.position = {0, 5, 0};
  ball.velocity = {0, 0, -2};
  ball.total_mass = 1;
  ball.total_stiffness = 500;
  return setup;
}

std::uint32_t index_of(const Model& model, std::string_view name) {
  return static_cast<std::uint32_t>(std::ranges::find(model.bodies, name, &ModelBody::name) - model.bodies.begin());
}

void check_same_motions(Session& session, const LoadedScene& opened) {
  const State now = session.simulation().state();
  REQUIRE(opened.start.model.bodies.size() == session.model().bodies.size());
  for (std::size_t b = 0; b < session.model().bodies.size(); ++b) {
    const ModelBody &body = session.model().bodies[b], &again = opened.start.model.bodies[b];
    CAPTURE(body.name);
    const BodyMotion was = body_motion(session.model(), now, b), is = body_motion(opened.start.model, opened.start.state, b);
    CHECK(glm::distance(was.centre, is.centre) < 1e-7);
    for (const glm::dvec3& point : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)})
      CHECK(glm::distance(was.rotation * point, is.rotation * point) < (body.path ? 1e-5 : 1e-7));  // a path rounds between keys
    if (!body.path || opened.description.bodies[b].path.empty()) CHECK(glm::distance(was.velocity, is.velocity) < 1e-7);
    if (!body.path) CHECK(glm::distance(was.spin, is.spin) < 1e-7);
    CHECK((again.name == body.name && again.kind == body.kind && again.color == body.color && again.surface == body.surface));
    CHECK((again.stiffness == body.stiffness && again.vertex_mass == body.vertex_mass && again.damping == body.damping));
    CHECK((again.restitution == body.restitution && again.is_container == body.is_container));
  }
}

TEST_CASE("a scene that is saved as it is opens with the same bodies in the same motion") {
  const test::ScratchFolder folder;
  const auto device = make_cpu_device(2, 32);
  Session session(*device, load_varied(folder));
  Settings settings = session.settings();
  settings.friction = 0.75;
  settings.restitution = 0.125;
  settings.damping_law = DampingLaw::none;
  settings.materials[0].stiffness *= 1.5;
  settings.materials[1].vertex_mass *= 3;
  session.change(settings);
  session.advance_toward(0.3, 1000);
  session.add(ball_beside());
  session.remove(index_of(session.model(), "row[0,0,0]"));
  session.advance_toward(0.35, 1000);
  const LoadedScene opened = saved_and_opened(session, folder);
  check_same_motions(session, opened);
  CHECK(settings_of(opened) == session.settings());
  CHECK(opened.start.model.grounds.size() == 1);
  CHECK(index_of(opened.start.model, "thrown 1") < opened.start.model.bodies.size());
  const BodyDescription& door = opened.description.bodies[index_of(opened.start.model, "door")];
  REQUIRE(door.path.size() == 2);
  CHECK(door.path.back().time == Approx(0.65));
  CHECK(Session(*device, opened).simulation().intersections().pairs == 0);
}

TEST_CASE("a scene that is saved before it begins is the same scene") {
  const test::ScratchFolder folder;
  const auto device = make_cpu_device(2, 32);
  Session session(*device, load_varied(folder));
  const LoadedScene opened = saved_and_opened(session, folder);
  CHECK(opened.start.state.motion == session.start().motion);
  CHECK(opened.description.bodies[0].stretch == glm::dvec3(0.9, 1, 1));
  CHECK(opened.description.bodies[0].total_stiffness == 2000.0);
}

TEST_CASE("what was shaken and what has come to its path's end stands where it is, and the hand is not saved") {
  const test::ScratchFolder folder;
  const auto device = make_cpu_device(2, 32);
  Session session(*device, load_varied(folder));
  session.shake();
  session.put_hand({0, 8, 0}, 0.2);
  session.advance_toward(0.5, 1000);
  {
    const LoadedScene opened = saved_and_opened(session, folder);
    CHECK(opened.start.model.bodies.size() == 7);
    CHECK(opened.start.model.bodies.back().kind == BodyKind::scripted);
    CHECK(opened.start.model.bodies.back().is_container);
  }
  session.advance_toward(1.5, 1000);
  const LoadedScene opened = saved_and_opened(session, folder);
  CHECK(opened.start.model.bodies.back().kind == BodyKind::immovable);
  CHECK(glm::distance(opened.description.bodies.back().position, glm::dvec3(9, 0, 0)) < 1e-7);  // rest positions are in fp32
  const std::uint32_t door = index_of(opened.start.model, "door");
  CHECK(opened.start.model.bodies[door].kind == BodyKind::immovable);
  CHECK(glm::distance(opened.description.bodies[door].position, glm::dvec3(-11, 2, 0)) < 1e-6);
  CHECK(glm::distance(opened.description.bodies[door].rotation, glm::dvec3(0, 45, 0)) < 1e-4);
}

}  // namespace
