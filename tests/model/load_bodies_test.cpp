#include "model/load_bodies.hpp"

#include "mesh/report.hpp"
#include "support/expect_error.hpp"
#include "support/paths.hpp"

namespace pliant {
namespace {

SceneDescription scene_with(const char* mesh) {
  SceneDescription scene;
  scene.file = source_dir() + "/scenes/none.toml";
  scene.bodies.resize(1);
  scene.bodies[0].name = "pot";
  scene.bodies[0].mesh_where = {Origin::From::file, "none.toml:3: body.pot.mesh"};
  scene.bodies[0].mesh = mesh;
  return scene;
}

}  // namespace

TEST_CASE("a mesh's path is relative to the scene file's folder") {
  CHECK(load_bodies(scene_with("../meshes/bunny.obj"))[0].mesh.positions.size() == 1839);
}

TEST_CASE("the welding distance is in metres, whatever the scale") {
  SceneDescription scene = scene_with("../meshes/teapot.obj");
  scene.bodies[0].weld = 1e-6;
  for (const double scale : {1e-3, 1.0, 1e3}) {
    scene.bodies[0].scale = scale;
    CHECK(load_bodies(scene)[0].mesh.positions.size() == 529);
  }
  scene.bodies[0].weld = 1.0;
  const auto count = [&](double scale) {
    scene.bodies[0].scale = scale;
    return load_bodies(scene)[0].mesh.positions.size();
  };
  CHECK(count(1.0) < count(2.0));
}

TEST_CASE("a body's mesh is subdivided behind welding, so that seams stay closed") {
  SceneDescription scene = scene_with("../meshes/teapot.obj");
  scene.bodies[0].weld = 1e-6;
  const MeshReport coarse = report_mesh(load_bodies(scene)[0].mesh);
  scene.bodies[0].subdivide = 1;
  const MeshReport fine = report_mesh(load_bodies(scene)[0].mesh);
  CHECK(fine.vertex_count == coarse.vertex_count + coarse.edge_count);
  CHECK(fine.triangle_count == 4 * coarse.triangle_count);
  CHECK(fine.boundary_edge_count == 2 * coarse.boundary_edge_count);
}

TEST_CASE("bodies of one file may be subdivided in different ways") {
  SceneDescription scene = scene_with("icosphere:1");
  scene.bodies.resize(4, scene.bodies[0]);
  scene.bodies[1].subdivide = scene.bodies[2].subdivide = scene.bodies[3].subdivide = 1;
  scene.bodies[2].subdivision = Subdivision::loop;
  scene.bodies[3].kind = BodyKind::immovable;
  const std::vector<BodySetup> setups = load_bodies(scene);
  CHECK((setups[0].mesh.positions.size() == 42 && setups[1].mesh.positions.size() == 162));
  CHECK(setups[2].mesh.triangles == setups[1].mesh.triangles);
  CHECK(setups[2].mesh.positions != setups[1].mesh.positions);
  CHECK(setups[3].mesh.positions == setups[1].mesh.positions);
}

TEST_CASE("too many subdivisions are an error that blames their key") {
  SceneDescription scene = scene_with("icosphere:3");
  scene.bodies[0].subdivide = 12;
  scene.bodies[0].subdivide_where = {Origin::From::file, "none.toml:4: body.pot.subdivide"};
  const Error error = error_of([&] { return load_bodies(scene); });
  CHECK(error.kind() == ErrorKind::input);
  check_says(error, {"none.toml:4: body.pot.subdivide: 12 subdivisions of 642 vertices", "subdivide 10 times at most"});
}

TEST_CASE("a warning begins with its body's name") {
  SceneDescription scene = scene_with("../meshes/teapot.obj");
  scene.bodies[0].weld = 1.0;
  std::vector<std::string> warnings;
  static_cast<void>(load_bodies(scene, &warnings));
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::StartsWith("pot: "));
  CHECK_THAT(warnings[0], Catch::Contains("collapsed"));
}

TEST_CASE("what is wrong with a mesh of several bodies is told once") {
  SceneDescription scene = scene_with("../meshes/teapot.obj");
  scene.bodies[0].weld = 1.0;
  scene.bodies.resize(3, scene.bodies[0]);
  scene.bodies[2].scale = 2;  // which welds other vertices
  std::vector<std::string> warnings;
  const std::vector<BodySetup> setups = load_bodies(scene, &warnings);
  CHECK(warnings.size() == 2);
  CHECK(setups[1].mesh.positions == setups[0].mesh.positions);
  CHECK(setups[2].mesh.positions.size() > setups[0].mesh.positions.size());
}

TEST_CASE("a mesh that can't be had is an input error that names the body's place in the scene") {
  for (const char* mesh : {"no/such.obj", "box:3", "icosphere:10"}) {
    CAPTURE(mesh);
    const Error error = error_of([&] { return load_bodies(scene_with(mesh)); });
    CHECK(error.kind() == ErrorKind::input);
    check_says(error, {"none.toml:3: body.pot.mesh: ", mesh});
  }
}

TEST_CASE("a mesh that an option names is that option's fault") {
  SceneDescription scene = scene_with("icosphere:10");
  scene.bodies[0].mesh_where = {Origin::From::override, "--set body.pot.mesh=icosphere:10: body.pot.mesh"};
  const Error error = error_of([&] { return load_bodies(scene); });
  CHECK(error.kind() == ErrorKind::command_line);
  check_says(error, {"--set body.pot.mesh=icosphere:10", "10 subdivisions are beyond 9"});
}

TEST_CASE("a mesh that is no file is told what else a mesh can be") {
  check_says(error_of([&] { return load_bodies(scene_with("cone")); }), {"cone", "no such file", "icosphere:n"});
}

TEST_CASE("welding everything into one vertex is an input error") {
  SceneDescription scene = scene_with("icosphere:1");
  scene.bodies[0].weld = 100;
  check_says(error_of([&] { return load_bodies(scene); }), {"none.toml:3: body.pot.mesh: ", "leaves no triangles"});
}

}  // namespace pliant
