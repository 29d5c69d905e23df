#include "scene/load_scene.hpp"

#include <fstream>

#include "support/expect_error.hpp"
#include "support/paths.hpp"
#include "support/scene_text.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

TEST_CASE("a body with a mesh is a scene, and all else has the documented default") {
  const SceneDescription scene = load_text(smallest);
  CHECK(scene.title.empty());
  CHECK(scene.file.filename() == "scene.toml");
  CHECK(scene.simulation.integrator.value == "dop853");
  CHECK_FALSE(scene.simulation.time_step);
  CHECK_FALSE(scene.simulation.tolerance);
  CHECK(scene.simulation.duration == 2.0);
  CHECK_FALSE(scene.simulation.damping_law);
  CHECK(scene.simulation.gravity == glm::dvec3(0.0));
  CHECK(scene.collision.response.value == "impulse");
  CHECK_FALSE(scene.collision.elasticity);
  CHECK((scene.collision.friction == 0.5 && scene.collision.gap == 0.05 && !scene.collision.restitution));
  CHECK(scene.collision.search == ContactSearch::tree);
  CHECK(scene.collision.triangle_test == TriangleTest::certified);
  CHECK_FALSE(scene.collision.tree.max_depth);
  CHECK(scene.collision.tree.leaf_size == 4);
  CHECK((scene.collision.tree.fan_out == 8 && !scene.collision.tree.refit));
  CHECK(scene.output.frame_rate == 60.0);
  CHECK(scene.output.size == glm::uvec2(1280, 720));
  CHECK_FALSE(scene.output.camera);
  CHECK((scene.output.coloring == Coloring::body && scene.output.marks == Marks::none));
  CHECK_FALSE(scene.output.ground_height);
  CHECK(scene.grounds.empty());
  REQUIRE(scene.bodies.size() == 1);
  const BodyDescription& body = scene.bodies[0];
  CHECK((body.name == "body0" && body.mesh == "icosphere:1" && !body.weld && body.scale == 1.0));
  CHECK((body.subdivide == 0 && body.subdivision == Subdivision::midpoint));
  CHECK((body.stiffness == 40.0 && !body.total_stiffness && body.vertex_mass == 1.0 && !body.total_mass && body.damping == 1.0));
  CHECK(body.kind == BodyKind::soft);
  CHECK((body.position == glm::dvec3(0.0) && body.rotation == glm::dvec3(0.0)));
  CHECK((body.velocity == glm::dvec3(0.0) && body.spin == glm::dvec3(0.0) && body.stretch == glm::dvec3(1.0)));
  CHECK((!body.surface.elasticity && !body.surface.friction && !body.surface.gap && !body.restitution));
  CHECK((body.pressure == 0.0 && body.pressure_law == PressureLaw::gas));
  CHECK_THAT(body.where, Catch::EndsWith("scene.toml:1"));
}

TEST_CASE("bodies without a colour have colours of their own") {
  std::string bodies;
  for (int i = 0; i < 7; ++i) bodies += "[[body]]\nmesh = \"icosphere:1\"\n";
  const SceneDescription scene = load_text(bodies);
  for (const BodyDescription& a : scene.bodies) {
    for (int axis = 0; axis < 3; ++axis) CHECK((a.color[axis] >= 0 && a.color[axis] <= 1));
    CHECK(std::ranges::count(scene.bodies, a.color, &BodyDescription::color) == 1);
  }
}

TEST_CASE("every key is read into its place") {
  const SceneDescription scene = load_text(R"(
title = "All keys"
[simulation]
integrator = "cv8"
time_step = 0.25
duration = 3
damping_law = "constant"
gravity = [1, -9.81, 2]
[collision]
response = "none"
elasticity = 1
search = "brute_force"
triangle_test = "moller"
[collision.tree]
split = "centre"
fan_out = 4
refit = "hybrid"
max_depth = 12
leaf_size = 7
[output]
frame_rate = 24
size = [640, 480]
camera = { eye = [0, 2, 6], target = [1, 0, 0], field_of_view = 50 }
coloring = "deformation"
marks = "contacts"
ground_height = -1.5
[[body]]
name = "thing"
mesh = "thing.obj"
weld = 1e-6
subdivide = 2
subdivision = "loop"
scale = 2
position = [1, 2, 3]
rotation = [4, 5, 6]
velocity = [7, 8, 9]
spin = [1.5, 2.5, 3.5]
stretch = [0.5, 1, 2]
total_stiffness = 1000
total_mass = 10
damping = 0
forces = "clustered"
force_tolerance = 2e-3
pressure = 2.5
pressure_law = "constant"
color = [0.1, 0.2, 0.3]
)");
  CHECK(scene.title == "All keys");
  CHECK(scene.simulation.integrator.value == "cv8");
  CHECK_THAT(scene.simulation.integrator.where.place, Catch::EndsWith("scene.toml:4: simulation.integrator"));
  CHECK(scene.simulation.time_step == 0.25);
  CHECK(scene.simulation.duration == 3);
  CHECK(scene.simulation.damping_law == DampingLaw::constant);
  CHECK(scene.simulation.gravity == glm::dvec3(1, -9.81, 2));
  CHECK(scene.collision.response.value == "none");
  CHECK(scene.collision.elasticity == 1);
  CHECK(scene.collision.search == ContactSearch::brute_force);
  CHECK(scene.collision.triangle_test == TriangleTest::moller);
  CHECK(scene.collision.tree.max_depth == 12);
  CHECK(scene.collision.tree.leaf_size == 7);
  CHECK((scene.collision.tree.fan_out == 4 && scene.collision.tree.refit == TreeRefit::hybrid));
  CHECK(scene.output.frame_rate == 24);
  CHECK(scene.output.size == glm::uvec2(640, 480));
  REQUIRE(scene.output.camera);
  CHECK(scene.output.camera->eye == glm::dvec3(0, 2, 6));
  CHECK(scene.output.camera->target == glm::dvec3(1, 0, 0));
  CHECK(scene.output.camera->field_of_view == 50);
  CHECK(scene.output.coloring == Coloring::deformation);
  CHECK(scene.output.marks == Marks::contacts);
  CHECK(scene.output.ground_height == -1.5);
  const BodyDescription& body = scene.bodies.at(0);
  CHECK((body.name == "thing" && body.mesh == "thing.obj" && body.weld == 1e-6 && body.scale == 2));
  CHECK((body.subdivide == 2 && body.subdivision == Subdivision::loop));
  CHECK((body.position == glm::dvec3(1, 2, 3) && body.rotation == glm::dvec3(4, 5, 6) && body.velocity == glm::dvec3(7, 8, 9)));
  CHECK((body.spin == glm::dvec3(1.5, 2.5, 3.5) && body.stretch == glm::dvec3(0.5, 1, 2) &&
         body.color == glm::dvec3(0.1, 0.2, 0.3)));
  CHECK((body.total_stiffness == 1000 && body.total_mass == 10 && body.damping == 0));
  CHECK((body.forces == ForceSum::clustered && body.force_tolerance == 2e-3));
  CHECK((body.pressure == 2.5 && body.pressure_law == PressureLaw::constant));
}

TEST_CASE("a pressure is a number that is not negative, and its law one of two") {
  check_input_error(smallest + "pressure = -1\n", 3, {"pressure", "-1"});
  check_input_error(smallest + "pressure = \"high\"\n", 3, {"pressure"});
  check_input_error(smallest + "pressure = 1\npressure_law = \"gass\"\n", 4, {"pressure_law", "gass", "gas", "constant"});
  check_override_error(smallest, "body.body0.pressure=-1", {"pressure"});
  const SceneDescription scene = load_text(smallest + "pressure = 1\npressure_law = \"gas\"\n");
  CHECK((scene.bodies[0].pressure == 1 && scene.bodies[0].pressure_law == PressureLaw::gas));
}

TEST_CASE("time_step = \"auto\" leaves the step to be chosen") {
  CHECK_FALSE(load_text("[simulation]\ntime_step = \"auto\"\n" + smallest).simulation.time_step);
}

TEST_CASE("a tolerance replaces the step, and knows where it stands") {
  const SceneDescription scene = load_text("[simulation]\ntolerance = 1e-6\n" + smallest);
  CHECK(scene.simulation.tolerance == 1e-6);
  CHECK_THAT(scene.simulation.tolerance_where.place, Catch::EndsWith("scene.toml:2: simulation.tolerance"));
  CHECK_FALSE(scene.simulation.time_step);
}

TEST_CASE("an unknown key is an error that suggests the known ones that contain it, or the nearest") {
  check_input_error("[simulation]\ntime_stp = 0.1\n" + smallest, 2,
                    {"simulation.time_stp", "unknown key", "did you mean \"time_step\"?"});
  check_input_error("[[body]]\nmesh = \"icosphere:1\"\nstifness = 4\n", 3,
                    {"body.body0.stifness", "did you mean \"stiffness\"?"});
  check_input_error("[[body]]\nmesh = \"icosphere:1\"\ncolour = [1, 1, 1]\n", 3, {"did you mean \"color\"?"});
  check_input_error("[[body]]\nmesh = \"icosphere:1\"\nmass = 4\n", 3, {"did you mean \"vertex_mass\" or \"total_mass\"?"});
  check_input_error("titel = \"x\"\n" + smallest, 1, {"titel", "did you mean \"title\"?"});
  check_input_error("[colision]\n" + smallest, 1, {"colision", "did you mean \"collision\"?"});
  check_input_error("[collision.tree]\nwhatever = 1\n" + smallest, 2,
                    {"collision.tree.whatever", "split, fan_out, refit, max_depth, leaf_size"});
  check_input_error("[simulation]\nwhatever = 1\n" + smallest, 2,
                    {"known here: integrator, time_step, tolerance, duration, damping_law, gravity"});
}

TEST_CASE("a value of the wrong type is an error that says what to write") {
  check_input_error("title = 3\n" + smallest, 1, {"title: is a whole number", "string"});
  check_input_error("[simulation]\nduration = \"long\"\n" + smallest, 2, {"simulation.duration: is a string", "number"});
  check_input_error("[simulation]\ntime_step = \"fast\"\n" + smallest, 2, {"simulation.time_step: is a string", "\"auto\""});
  check_input_error("[simulation]\ntime_step = true\n" + smallest, 2, {"is true or false"});
  check_input_error("[simulation]\ngravity = -9.81\n" + smallest, 2, {"simulation.gravity: is a number", "array of 3"});
  check_input_error("[simulation]\ngravity = [0, -9.81]\n" + smallest, 2, {"has 2 elements"});
  check_input_error("[simulation]\ngravity = [0, \"down\", 0]\n" + smallest, 2, {"simulation.gravity[1]: is a string"});
  check_input_error("[simulation]\nduration = 1979-05-27\n" + smallest, 2, {"a date"});
  check_input_error("[collision.tree]\nmax_depth = 3.5\n" + smallest, 2, {"collision.tree.max_depth: is no whole number"});
  check_input_error("[output]\ncamera = 3\n" + smallest, 2, {"output.camera: is a whole number", "table"});
  check_input_error("simulation = 3\n" + smallest, 1, {"simulation: is a whole number", "[simulation]"});
  check_input_error("[[simulation]]\n" + smallest, 1, {"simulation: is an array"});
  check_input_error("[body]\nmesh = \"icosphere:1\"\n", 1, {"body: is a table", "[[body]]"});
  check_input_error("body = [1]\n", 1, {"body.body0: is a whole number"});
  check_input_error("[[body]]\nmesh = 3\n", 2, {"body.body0.mesh: is a whole number"});
}

TEST_CASE("a value out of range is an error that gives the range") {
  for (const char* line : {"simulation.time_step = 0",     "simulation.time_step = -1",
                           "simulation.time_step = nan",   "simulation.time_step = inf",
                           "simulation.tolerance = -1e-6", "simulation.tolerance = nan",
                           "simulation.tolerance = 0",     "simulation.tolerance = 1e-15",
                           "simulation.tolerance = 1",     "simulation.duration = -1e-9",
                           "simulation.duration = inf",    "simulation.gravity = [0, nan, 0]",
                           "collision.elasticity = -0.1",  "collision.elasticity = 1.1",
                           "collision.restitution = -0.1", "collision.restitution = 1.1",
                           "collision.gap = 0.009",        "collision.gap = 0.11",
                           "collision.friction = -0.1",    "collision.friction = inf",
                           "collision.tree.max_depth = 0", "collision.tree.max_depth = 65",
                           "collision.tree.leaf_size = 0", "collision.tree.leaf_size = -4",
                           "output.frame_rate = 0",        "output.frame_rate = 1e30",
                           "output.frame_rate = 1e-30",    "output.size = [0, 720]",
                           "output.size = [1280, 99999]",  "output.camera = { eye = [0, 0, 5], field_of_view = 180 }",
                           "output.ground_height = nan"}) {
    check_input_error(std::string(line) + "\n" + smallest, 1, {"out of range", "write a"});
  }
  for (const char* line : {"weld = -1",
                           "subdivide = -1",
                           "subdivide = 16",
                           "scale = 0",
                           "scale = -1",
                           "position = [2e9, 0, 0]",
                           "velocity = [0, inf, 0]",
                           "spin = [nan, 0, 0]",
                           "rotation = [0, 0, -inf]",
                           "stretch = [1, 1, nan]",
                           "stiffness = -1",
                           "total_stiffness = -1",
                           "vertex_mass = 0",
                           "total_mass = 0",
                           "damping = -1",
                           "damping = nan",
                           "color = [0, 0, 1.5]",
                           "elasticity = 1.1",
                           "friction = -1",
                           "restitution = 2",
                           "gap = 0"}) {
    check_input_error("[[body]]\nmesh = \"icosphere:1\"\n" + std::string(line) + "\n", 3,
                      {"body.body0.", "out of range", "write a"});
  }
  for (const char* line :
       {"height = nan", "point = [0, 2e9, 0]", "normal = [0, inf, 0]", "elasticity = -1", "friction = -1", "gap = 1"})
    check_input_error("[[ground]]\n" + std::string(line) + "\n" + smallest, 2, {"ground.", "out of range", "write a"});
}

TEST_CASE("every damping law is read by its name") {
  for (const DampingLaw law : {DampingLaw::none, DampingLaw::constant, DampingLaw::adaptive, DampingLaw::internal})
    CHECK(load_text("[simulation]\ndamping_law = \"" + std::string(name_of(law)) + "\"\n" + smallest).simulation.damping_law ==
          law);
}

TEST_CASE("a word that is no choice is an error that lists the choices") {
  check_input_error("[simulation]\ndamping_law = \"strong\"\n" + smallest, 2,
                    {"\"strong\" is no choice", "none, constant, adaptive, internal"});
  check_input_error("[collision]\nsearch = \"grid\"\n" + smallest, 2, {"tree, brute_force"});
  check_input_error("[collision]\ntriangle_test = \"exact\"\n" + smallest, 2, {"certified, moller"});
  check_input_error("[collision.tree]\nsplit = \"middle\"\n" + smallest, 2, {"centre", "median", "surface_area"});
  check_input_error("[collision.tree]\nrefit = \"lazy\"\n" + smallest, 2, {"bottom_up", "hybrid"});
  for (const char* fan_out : {"1", "3", "6", "16", "4.0"})
    check_input_error(std::string("[collision.tree]\nfan_out = ") + fan_out + "\n" + smallest, 2, {"fan_out", "2, 4 or 8"});
  check_input_error(smallest + "subdivision = \"butterfly\"\n", 3, {"midpoint, loop"});
  check_input_error(smallest + "forces = \"fast\"\n", 3, {"auto, direct, clustered"});
  for (const char* beyond : {"0", "-1e-3", "0.2", "1e-9", "\"auto\""})
    check_input_error(smallest + "force_tolerance = " + beyond + "\n", 3, {"force_tolerance", "1e-8 to 0.1"});
  check_input_error("[output]\ncoloring = \"rainbow\"\n" + smallest, 2, {"body, deformation"});
  check_input_error("[output]\nmarks = \"boxes\"\n" + smallest, 2, {"none, contacts"});
}

TEST_CASE("keys that contradict each other are an error") {
  check_input_error(smallest + "stiffness = 1\ntotal_stiffness = 1\n", 4,
                    {"body.body0.total_stiffness", "can't be combined with stiffness"});
  check_input_error("[simulation]\ntolerance = 1e-6\ntime_step = 0.1\n" + smallest, 2,
                    {"simulation.tolerance", "can't be combined with time_step", "keep one"});
  check_input_error(smallest + "total_mass = 1\nvertex_mass = 1\n", 3,
                    {"body.body0.total_mass", "can't be combined with vertex_mass"});
}

TEST_CASE("grounds, static bodies and what contacts need to know of them are read into their places") {
  const SceneDescription scene = load_text(
      "[collision]\nfriction = 0.25\nrestitution = 0.7\ngap = 0.02\n[[ground]]\nheight = -1\nfriction = 2\n[[ground]]\npoint = "
      "[1, 2, "
      "3]\nnormal = [0, 3, 4]\nelasticity = 0.5\n" +
      smallest + "kind = \"static\"\nfriction = 0.1\nelasticity = 0.2\nrestitution = 0.4\ngap = 0.1\n");
  CHECK((scene.collision.friction == 0.25 && scene.collision.gap == 0.02));
  REQUIRE(scene.grounds.size() == 2);
  CHECK((scene.grounds[0].point == glm::dvec3(0, -1, 0) && scene.grounds[0].normal == glm::dvec3(0, 1, 0)));
  CHECK((scene.grounds[0].surface.friction == 2 && !scene.grounds[0].surface.elasticity));
  CHECK((scene.grounds[1].point == glm::dvec3(1, 2, 3) && scene.grounds[1].normal == glm::dvec3(0, 3, 4)));
  CHECK(scene.grounds[1].surface.elasticity == 0.5);
  CHECK(scene.output.ground_height == -1);  // the first is level, and drawn
  CHECK(scene.bodies[0].kind == BodyKind::immovable);
  CHECK((scene.bodies[0].surface.friction == 0.1 && scene.bodies[0].surface.elasticity == 0.2 &&
         scene.bodies[0].surface.gap == 0.1));
  CHECK((scene.collision.restitution == 0.7 && scene.bodies[0].restitution == 0.4));
}

TEST_CASE("overrides replace all grounds together, and reach no key of one") {
  const std::string grounds = "[[ground]]\nheight = 1\n[[ground]]\nnormal = [1, 0, 0]\n" + smallest;
  CHECK(load_text(grounds, {"ground=[]"}).grounds.empty());
  const SceneDescription replaced = load_text(grounds, {"ground=[{height=2, friction=0.3}]"});
  REQUIRE(replaced.grounds.size() == 1);
  CHECK((replaced.grounds[0].point.y == 2 && replaced.grounds[0].surface.friction == 0.3));
  CHECK(load_text(smallest, {"ground=[{height=-1}]"}).grounds.size() == 1);
  for (const char* key : {"ground.height=1", "ground.0.height=1"})
    for (const std::string& text : {grounds, smallest})
      check_override_error(text, key, {"grounds have no names", "--set 'ground=[{height=1}]'"});
  check_override_error(grounds, "ground=5", {"is a whole number", "--set 'ground=[{height=1}]'"});
  check_override_error(grounds, "body=5", {"is a whole number", "--set 'body.NAME.velocity"});
}

TEST_CASE("the drawn floor is the first ground that is level and faces up") {
  const std::string slope = "[[ground]]\nnormal = [1, 1, 0]\n", ceiling = "[[ground]]\npoint = [0, 5, 0]\nnormal = [0, -1, 0]\n";
  CHECK_FALSE(load_text(slope + ceiling + smallest).output.ground_height);
  CHECK(load_text(slope + ceiling + "[[ground]]\nheight = -2\n[[ground]]\n" + smallest).output.ground_height == -2);
  CHECK(load_text("[output]\nground_height = -3\n" + ceiling + smallest).output.ground_height == -3);
}

TEST_CASE("what never moves does not move, and a ground is told in one way") {
  for (const char* key :
       {"velocity = [1, 0, 0]", "spin = [1, 0, 0]", "stretch = [1, 2, 1]", "pressure = 1", "self_contact = true"})
    check_input_error(smallest + "kind = \"static\"\n" + key + "\n", 4, {"neither moves nor changes", "remove"});
  check_input_error("[[ground]]\nheight = 1\nnormal = [1, 0, 0]\n" + smallest, 3, {"can't be combined with height"});
  check_input_error("[[ground]]\nnormal = [0, 0, 0]\n" + smallest, 2, {"has no direction"});
  check_input_error("[output]\nground_height = 1\n[[ground]]\n" + smallest, 3, {"ground", "remove output.ground_height"});
}

TEST_CASE("a path is read key by key, and what a key leaves out is as in the one before") {
  const SceneDescription scene =
      load_text(smallest +
                "kind = \"scripted\"\nrepeats = true\nposition = [9, 0, 0]\npath = [{ time = 0.5 }, "
                "{ time = 1, position = [1, 2, 3] }, { time = 2, rotation = [0, 360, 0], position = [0, 0, 0] }]\n");
  const BodyDescription& body = scene.bodies.at(0);
  CHECK((body.kind == BodyKind::scripted && body.repeats && body.position == glm::dvec3(9, 0, 0)));
  REQUIRE(body.path.size() == 3);
  CHECK(
      (body.path[0].time == 0.5 && body.path[0].position == glm::dvec3(0, 0, 0) && body.path[0].rotation == glm::dvec3(0, 0, 0)));
  CHECK((body.path[1].time == 1 && body.path[1].position == glm::dvec3(1, 2, 3) && body.path[1].rotation == glm::dvec3(0, 0, 0)));
  CHECK(
      (body.path[2].time == 2 && body.path[2].position == glm::dvec3(0, 0, 0) && body.path[2].rotation == glm::dvec3(0, 360, 0)));
}

TEST_CASE("a path that leads nowhere is an error where it stands") {
  const std::string scripted = smallest + "kind = \"scripted\"\n";
  check_input_error(scripted + "path = [{ time = 0 }]\n", 4, {"body.body0.path", "fewer than two keys", "write keys"});
  check_input_error(scripted + "path = 3\n", 4, {"body.body0.path", "is a whole number"});
  check_input_error(scripted + "path = [{ time = 0 }, 3]\n", 4, {"body.body0.path[1]", "write a table"});
  check_input_error(scripted + "path = [{ time = 0 }, { position = [0, 1, 0] }]\n", 4, {"path[1]", "has no time"});
  check_input_error(scripted + "path = [{ time = 1 }, { time = 1 }]\n", 4, {"path[1].time", "1 s is not after", "sort the keys"});
  check_input_error(scripted + "path = [{ time = -1 }, { time = 1 }]\n", 4, {"path[0].time", "from 0"});
  check_input_error(scripted + "path = [{ time = 0, place = [0, 0, 0] }, { time = 1 }]\n", 4, {"path[0].place", "unknown key"});
  const std::string repeating = scripted + "repeats = true\n";
  check_input_error(repeating + "path = [{ time = 0 }, { time = 1, position = [0, 1, 0] }]\n", 5,
                    {"does not end where it begins"});
  check_input_error(repeating + "path = [{ time = 0 }, { time = 1, rotation = [0, 90, 0] }]\n", 5,
                    {"does not end where it begins"});
  check_input_error(repeating, 4, {"no path to repeat"});
}

TEST_CASE("a scripted body has what moves it, and no other body has that") {
  const std::string path = "path = [{ time = 0 }, { time = 1, position = [0, 1, 0] }]\n";
  for (const char* kind : {"", "kind = \"soft\"\n", "kind = \"static\"\n"})
    CHECK_THROWS_WITH(load_text(smallest + kind + path), Catch::Contains("of the kind \"scripted\""));
  const std::string scripted = smallest + "kind = \"scripted\"\n";
  for (const char* key : {"stretch = [1, 2, 1]", "pressure = 1", "self_contact = true"})
    check_input_error(scripted + key + "\n", 4, {"does not change its shape", "remove"});
  check_input_error(scripted + "restitution = 0.5\n", 4, {"restitution", "remove"});
  for (const char* key : {"velocity = [1, 0, 0]", "spin = [1, 0, 0]"}) {
    check_input_error(scripted + path + key + "\n", 5, {"along it alone", "or path"});
    CHECK(load_text(scripted + key).bodies.at(0).path.empty());
  }
  CHECK(load_text(scripted + "damping = 3\n").bodies.at(0).idle_keys.at(0).why == "on a scripted body");
}

TEST_CASE("containers stand behind all bodies, and those that something moves are scripted") {
  const SceneDescription scene = load_text(
      "[[container]]\nsize = [2, 1, 3]\nfriction = 0.2\n"
      "[[container]]\nname = \"drum\"\nshape = \"sphere\"\nradius = 4\nspin = [1, 0, 0]\n"
      "[[container]]\nsize = [1, 1, 1]\nopen = true\npath = [{ time = 0 }, { time = 1 }]\n" +
      smallest);
  REQUIRE(scene.bodies.size() == 4);
  CHECK_FALSE(scene.bodies[0].is_container);
  const BodyDescription &box = scene.bodies[1], &drum = scene.bodies[2], &crate = scene.bodies[3];
  CHECK((box.is_container && box.name == "container0" && box.kind == BodyKind::immovable && box.mesh == "box:2,1,3,8"));
  CHECK(box.surface.friction == 0.2);
  CHECK((drum.name == "drum" && drum.kind == BodyKind::scripted && drum.mesh == "icosphere:3" && drum.scale == 4));
  CHECK((crate.kind == BodyKind::scripted && crate.mesh == "crate:1,1,1,8" && crate.path.size() == 2));
}

TEST_CASE("a container that holds nothing, or is none, is an error where it stands") {
  check_input_error("[[container]]\n" + smallest, 1, {"container", "has no size"});
  check_input_error("[[container]]\nsize = [0, 1, 1]\n" + smallest, 2, {"container.size[0]", "from 1e-6"});
  check_input_error("[[container]]\nsize = [1, 1, 1]\nradius = 1\n" + smallest, 3, {"a box has sizes"});
  check_input_error("[[container]]\nshape = \"sphere\"\n" + smallest, 1, {"has no radius"});
  check_input_error("[[container]]\nshape = \"sphere\"\nradius = 1\nopen = true\n" + smallest, 4, {"a radius alone"});
  check_input_error("[[container]]\nshape = \"cone\"\n" + smallest, 2, {"box, sphere"});
  check_input_error("[[container]]\nsize = [1, 1, 1]\nmesh = \"cube:1\"\n" + smallest, 3, {"unknown key"});
  check_input_error("[[container]]\nname = \"body0\"\nsize = [1, 1, 1]\n" + smallest, 1, {"the name is taken"});
  CHECK_THROWS_WITH(load_text("[[container]]\nsize = [1, 1, 1]\n"), Catch::Contains("has no body"));
  CHECK_THROWS_WITH(load_text("container = 3\n" + smallest), Catch::Contains("begin each container"));
}

TEST_CASE("a body is not stretched to a single point, and may be to a line") {
  check_input_error(smallest + "stretch = [0, 0.0, -0.0]\n", 3, {"body.body0.stretch", "one point", "write a factor"});
  check_override_error(smallest, "body.body0.stretch=[0, 0, 0]", {"one point"});
  CHECK(load_text(smallest + "stretch = [0, 0, 1]\n").bodies.at(0).stretch == glm::dvec3(0, 0, 1));
}

TEST_CASE("a whole number that no double holds is the nearest one") {
  CHECK(load_text(smallest + "weld = 9223372036854775807\n").bodies.at(0).weld == 0x1p63);
  check_input_error("[collision.tree]\nmax_depth = 9223372036854775807\n" + smallest, 2,
                    {"out of range", "write a whole number"});
}

TEST_CASE("a camera looks at something other than itself") {
  const std::string camera = "[output.camera]\neye = [1, 2, 3]\n";
  check_input_error(camera + "target = [1, 2, 3]\n" + smallest, 2, {"output.camera", "same point", "move"});
  check_override_error(camera + smallest, "output.camera.target=[1, 2, 3]", {"same point"});
}

TEST_CASE("a scene knows whether a value is the file's or the command line's, and where it stands") {
  const std::string text = "[simulation]\ntime_step = 0.5\n" + smallest;
  const SimulationDescription simulation = load_text(text, {"simulation.duration=1"}).simulation;
  CHECK(simulation.time_step_where.from == Origin::From::file);
  CHECK_THAT(simulation.time_step_where.place, Catch::EndsWith("scene.toml:2: simulation.time_step"));
  CHECK(simulation.duration_where.from == Origin::From::override);
  CHECK(simulation.duration_where.place == "--set simulation.duration=1: simulation.duration");
  CHECK(simulation.tolerance_where.from == Origin::From::nowhere);
}

TEST_CASE("a scene needs bodies, each with a mesh and a name of its own") {
  check_says(error_of([] { return load_text("title = \"empty\"\n"); }), {"scene.toml", "no body", "[[body]]"});
  check_says(error_of([] { return load_text(""); }), {"scene.toml", "no body"});
  check_says(error_of([] { return load_text("body = []\n"); }), {"scene.toml", "no body"});
  check_input_error(smallest + "[[body]]\nname = \"b\"\n", 3, {"body.b", "has no mesh"});
  check_input_error("[[body]]\nmesh = \"\"\n", 2, {"body.body0.mesh", "empty"});
  check_input_error("[[body]]\nmesh = \"a.obj\"\nname = \"\"\n", 3, {"name", "empty"});
  check_input_error("[[body]]\nmesh = \"a.obj\"\nname = \"a\\nb\"\n", 3, {"control character"});
  check_input_error("[[body]]\nmesh = \"a.obj\"\nname = \"body1\"\n[[body]]\nmesh = \"a.obj\"\n", 4, {"body.body1", "taken"});
  CHECK(load_text(two_named).bodies.at(1).name == "body1");
}

TEST_CASE("text that is no TOML is an error that names its line") {
  check_input_error("title = \"x\"\n[simulation\n", 2, {"TOML"});
  check_input_error("title = \"x\"\ntitle = \"y\"\n", 2, {"TOML"});
  check_input_error("title = \"\xff\xfe\"\n", 1, {"TOML"});
  check_input_error("title = \n", 1, {"TOML"});
  check_input_error("title = \"x\"\n[.a]\n" + smallest, 2, {"malformed key", "TOML"});
}

TEST_CASE("a missing scene and a folder are input errors that name the path") {
  const Error missing = error_of([] { return load_scene("no/such.toml"); });
  CHECK(missing.kind() == ErrorKind::input);
  check_says(missing, {"no/such.toml", "can't be opened"});
  const Error folder = error_of([] { return load_scene(source_dir()); });
  CHECK(folder.kind() == ErrorKind::input);
  check_says(folder, {"is a folder"});
}

TEST_CASE("a mesh is no scene, and is told so") {
  const Error mesh = error_of([] { return load_scene(source_dir() + "/meshes/teapot.obj"); });
  CHECK_THAT(mesh.what(), Catch::Contains("show it by pliant view"));
}

}  // namespace
}  // namespace pliant
