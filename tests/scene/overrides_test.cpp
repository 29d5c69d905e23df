// Values of a scene that the command line replaces or adds.
#include "support/scene_text.hpp"

namespace pliant {
namespace {

TEST_CASE("overrides replace, add and reach into sections that the file lacks") {
  const SceneDescription scene =
      load_text("[simulation]\ntime_step = 0.5\n" + two_named,
                {"simulation.time_step=0.25", "simulation.integrator=rk4", "collision.tree.max_depth = 9",
                 "output.camera.eye=[1, 2, 3]", "title=\"with spaces\"", "body.left.stiffness=80",
                 "body.body1.mesh=../meshes/bunny.obj", "body.left.name=port", "body.port.damping=7"});
  CHECK(scene.simulation.time_step == 0.25);
  CHECK(scene.simulation.integrator.value == "rk4");
  CHECK(scene.simulation.integrator.where.place == "--set simulation.integrator=rk4: simulation.integrator");
  CHECK(scene.collision.tree.max_depth == 9);
  CHECK(scene.output.camera->eye == glm::dvec3(1, 2, 3));
  CHECK(scene.title == "with spaces");
  CHECK((scene.bodies[0].name == "port" && scene.bodies[0].stiffness == 80 && scene.bodies[0].damping == 7));
  CHECK(scene.bodies[1].mesh == "../meshes/bunny.obj");
  CHECK(scene.bodies[1].mesh_where.place == "--set body.body1.mesh=../meshes/bunny.obj: body.body1.mesh");
}

TEST_CASE("a later override wins, and auto replaces a step") {
  const std::string text = "[simulation]\ntime_step = 0.5\n" + smallest;
  CHECK(load_text(text, {"simulation.time_step=1", "simulation.time_step=2"}).simulation.time_step == 2);
  CHECK_FALSE(load_text(text, {"simulation.time_step=auto"}).simulation.time_step);
}

TEST_CASE("an override replaces the key of the file that it can't stand beside") {
  const std::string stiffness = "[simulation]\ntime_step = 0.5\n" + smallest + "stiffness = 3\n",
                    total = "[simulation]\ntolerance = 1e-6\n" + smallest + "total_stiffness = 3\n";
  const SceneDescription by_total = load_text(stiffness, {"body.body0.total_stiffness=7", "simulation.tolerance=1e-6"});
  CHECK((by_total.bodies[0].total_stiffness == 7 && by_total.bodies[0].stiffness == BodyDescription().stiffness));
  CHECK((by_total.simulation.tolerance == 1e-6 && !by_total.simulation.time_step));
  const SceneDescription by_one = load_text(total, {"body.body0.stiffness=7", "simulation.time_step=0.25"});
  CHECK((!by_one.bodies[0].total_stiffness && by_one.bodies[0].stiffness == 7));
  CHECK((!by_one.simulation.tolerance && by_one.simulation.time_step == 0.25));
  CHECK_FALSE(load_text(total, {"simulation.time_step=auto"}).simulation.tolerance);
  const Error both = error_of([] { return load_text(two_named, {"body.left.vertex_mass=1", "body.left.total_mass=1"}); });
  CHECK_THAT(both.what(), Catch::Contains("can't be combined with vertex_mass"));
}

TEST_CASE("a body's name may contain dots") {
  const std::string text = "[[body]]\nname = \"a.b\"\nmesh = \"icosphere:1\"\n";
  CHECK(load_text(text, {"body.a.b.stiffness=3"}).bodies[0].stiffness == 3);
}

TEST_CASE("a faulty override is a command line error that repeats it") {
  check_override_error(two_named, "simulation.time_step", {"no \"=\""});
  check_override_error(two_named, "=3", {"no key"});
  check_override_error(two_named, "", {"no key"});
  check_override_error(two_named, "simulation.time_step=", {"has no value"});
  check_override_error(two_named, "title=two words", {"no TOML"});
  check_override_error(two_named, "title=\xff\xfe", {"no TOML"});
  check_override_error(two_named, "simulation.gravity=[1,2", {"no TOML"});
  check_override_error(two_named, "simulation.duration=1\nextra = 2", {"no TOML"});
  check_override_error(two_named, "simulation.time_step=-1", {"simulation.time_step", "out of range"});
  check_override_error(two_named, "simulation.time_step=fast", {"is a string"});
  check_override_error(two_named, "simulation.time_stp=1", {"did you mean \"time_step\"?"});
  check_override_error(two_named, "simulatio.time_step=1", {"did you mean \"simulation\"?"});
  check_override_error(two_named, "collision.tree={max_deth = 3}", {"did you mean \"max_depth\"?"});
  check_override_error(two_named, "body.lefd.stiffness=1", {"no body \"lefd\"", "did you mean \"left\"?"});
  check_override_error(two_named, "body.stiffness=1", {"names no body"});
  check_override_error(two_named, "body.left.stifness=1", {"did you mean \"stiffness\"?"});
  check_override_error(two_named, "body.left.stiffness=many", {"is a string"});
  check_override_error("title = \"t\"\n" + two_named, "title.sub=1", {"\"title\" is no section"});
  check_override_error(two_named, "simulation..x=1", {"simulation"});
}

}  // namespace
}  // namespace pliant
