// Bodies that one table writes in rows.
#include <algorithm>

#include "support/scene_text.hpp"

namespace pliant {
namespace {

const std::string in_rows =
    "[[body]]\nname = \"a\"\nmesh = \"cube:1\"\n"
    "[[body]]\nname = \"ball\"\nmesh = \"icosphere:1\"\ncount = [2, 1, 3]\nspacing = [2, 9, -4]\n"
    "position = [10, 20, 30]\ntotal_mass = 5\n"
    "\"[1,0,2]\" = { velocity = [0, 0, 7], vertex_mass = 3, position = [1, 2, 3] }\n";

TEST_CASE("one table writes many bodies in rows, and any of them can differ") {
  const SceneDescription scene = load_text(in_rows);
  REQUIRE(scene.bodies.size() == 7);
  const char* names[] = {"a", "ball[0,0,0]", "ball[0,0,1]", "ball[0,0,2]", "ball[1,0,0]", "ball[1,0,1]", "ball[1,0,2]"};
  for (std::size_t b = 0; b < 7; ++b) {
    CAPTURE(b);
    const BodyDescription& body = scene.bodies[b];
    CHECK(body.name == names[b]);
    CHECK(body.color == default_color(b));
    if (b == 0) continue;
    CHECK(body.mesh == "icosphere:1");
    const bool is_last = b == 6;
    CHECK(body.velocity == glm::dvec3(0, 0, is_last ? 7 : 0));
    CHECK(body.total_mass == (is_last ? std::nullopt : std::optional(5.0)));
    CHECK(body.vertex_mass == (is_last ? 3 : 1));
    const double x = b > 3 ? 1 : 0, z = static_cast<double>((b - 1) % 3);
    CHECK(body.position == (is_last ? glm::dvec3(1, 2, 3) : glm::dvec3(10 + 2 * x, 20, 30 - 4 * z)));
  }
  CHECK_THAT(scene.bodies[6].where, Catch::EndsWith(":11"));
}

TEST_CASE("overrides reach all bodies in rows, or one of them") {
  const std::vector<std::string> overrides = {"body.ball.scale=2", "body.ball[0,0,1].scale=3", "body.ball[1,0,2].total_mass=8",
                                              "body.ball.count=[2,2,3]"};
  const SceneDescription scene = load_text(in_rows, overrides);
  REQUIRE(scene.bodies.size() == 13);
  for (std::size_t b = 1; b < 13; ++b) CHECK(scene.bodies[b].scale == (scene.bodies[b].name == "ball[0,0,1]" ? 3 : 2));
  const auto last = std::ranges::find(scene.bodies, "ball[1,0,2]", &BodyDescription::name);
  CHECK(last->total_mass == 8);  // in place of the file's vertex_mass
  for (const BodyDescription& body :
       load_text(in_rows, {"body.ball.self_contact=true", "body.ball[0,0,1].self_contact=false"}).bodies)
    CHECK(body.self_contact == (body.name != "a" && body.name != "ball[0,0,1]"));
  check_override_error(in_rows, "body.ball[2,0,0].scale=1", {"[2,0,0]", "none of the bodies", "[1,0,2]"});
  check_override_error(in_rows, "body.ball[0,0].scale=1", {"there is no body"});
  check_override_error(in_rows, "body.a[0,0,0].scale=1", {"there is no body"});
}

TEST_CASE("an override of all bodies in rows is stronger than what the file says of one") {
  const SceneDescription scene = load_text(in_rows, {"body.ball.velocity=[1,2,3]", "body.ball.total_mass=6"});
  for (std::size_t b = 1; b < scene.bodies.size(); ++b) {
    CHECK(scene.bodies[b].velocity == glm::dvec3(1, 2, 3));
    CHECK(scene.bodies[b].total_mass == 6);
  }
  const SceneDescription moved = load_text(in_rows, {"body.ball.position=[0,0,0]"});
  CHECK(moved.bodies[6].position == glm::dvec3(2, 0, -8));
  const SceneDescription one = load_text(in_rows, {"body.ball.velocity=[1,2,3]", "body.ball[1,0,2].velocity=[4,5,6]"});
  CHECK(one.bodies[6].velocity == glm::dvec3(4, 5, 6));
  check_override_error(in_rows, "body.none[0,0,0].scale=1", {"there is no body", "known here: a, ball"});
}

TEST_CASE("a static one of bodies in rows has none of what the others do") {
  const std::string moving = "velocity = [1, 0, 0]\nspin = [1, 0, 0]\npressure = 2\ndamping = 3\ntotal_mass = 5\n";
  const std::string rows = "[[body]]\nname = \"ball\"\nmesh = \"icosphere:1\"\ncount = [2, 1, 1]\nspacing = [3, 0, 0]\n" + moving;
  const SceneDescription scene = load_text(rows + "\"[1,0,0]\" = { kind = \"static\" }\n");
  CHECK(scene.bodies[0].velocity == glm::dvec3(1, 0, 0));
  CHECK(scene.bodies[1].kind == BodyKind::immovable);
  CHECK(scene.bodies[1].velocity == glm::dvec3(0, 0, 0));
  CHECK(scene.bodies[1].spin == glm::dvec3(0, 0, 0));
  CHECK(scene.bodies[1].pressure == 0);
  CHECK(scene.bodies[1].idle_keys.empty());
  check_input_error(rows + "\"[1,0,0]\" = { kind = \"static\", spin = [0, 1, 0] }\n", 11, {"body.ball[1,0,0].spin", "static"});
  check_override_error(rows + "\"[1,0,0]\" = { kind = \"static\", spin = [0, 1, 0] }\n", "body.ball.spin=[1,2,3]", {"static"});
}

TEST_CASE("one of bodies in rows may be of another kind than those on a path") {
  const std::string rows =
      "[[body]]\nname = \"ball\"\nmesh = \"icosphere:1\"\ncount = [2, 1, 1]\nspacing = [3, 0, 0]\nkind = \"scripted\"\n"
      "path = [{ time = 0 }, { time = 1, position = [0, 1, 0] }]\n";
  for (const BodyDescription& body : load_text(rows).bodies) CHECK(body.path.size() == 2);
  for (const char* kind : {"soft", "static"}) {
    const SceneDescription scene = load_text(rows + "\"[1,0,0]\" = { kind = \"" + kind + "\" }\n");
    CHECK(scene.bodies[0].path.size() == 2);
    CHECK(scene.bodies[1].path.empty());
  }
  const SceneDescription one = load_text(
      "[[body]]\nname = \"ball\"\nmesh = \"icosphere:1\"\ncount = [2, 1, 1]\nspacing = [3, 0, 0]\nrestitution = 0.5\n"
      "velocity = [1, 0, 0]\n\"[1,0,0]\" = { kind = \"scripted\", path = [{ time = 0 }, { time = 1, position = [0, 1, 0] }] }\n");
  CHECK((one.bodies[0].restitution == 0.5 && !one.bodies[1].restitution && one.bodies[1].velocity == glm::dvec3(0.0)));
}

TEST_CASE("a key of rows is idle only if it is for all of their bodies") {
  const std::string rows =
      "[[body]]\nname = \"ball\"\nmesh = \"icosphere:1\"\ncount = [2, 1, 1]\nspacing = [3, 0, 0]\nkind = \"static\"\n"
      "total_mass = 5\npressure_law = \"constant\"\n";
  for (const BodyDescription& body : load_text(rows).bodies) CHECK(body.idle_keys.size() == 2);
  const SceneDescription mixed = load_text(rows + "\"[1,0,0]\" = { kind = \"soft\", pressure = 2 }\n");
  for (const BodyDescription& body : mixed.bodies) CHECK(body.idle_keys.empty());
  const SceneDescription own = load_text(rows + "\"[0,0,0]\" = { damping = 2 }\n\"[1,0,0]\" = { kind = \"soft\" }\n");
  REQUIRE(own.bodies[0].idle_keys.size() == 2);
  CHECK_THAT(own.bodies[0].idle_keys[0].where.place, Catch::Contains("damping"));
  CHECK_THAT(own.bodies[0].idle_keys[1].where.place, Catch::Contains("pressure_law"));
  for (const IdleKey& key : own.bodies[0].idle_keys) CHECK(key.why == "on a static body");
  const SceneDescription replaced = load_text(rows + "\"[1,0,0]\" = { total_mass = 6 }\n");
  CHECK_THAT(replaced.bodies[0].idle_keys[0].where.place, Catch::Contains("body.ball.total_mass"));
  const std::string soft =
      "[[body]]\nname = \"ball\"\nmesh = \"icosphere:1\"\ncount = [2, 1, 1]\nspacing = [3, 0, 0]\npressure_law = \"constant\"\n";
  CHECK(load_text(soft + "\"[1,0,0]\" = { kind = \"static\" }\n").bodies[0].idle_keys.size() == 1);
}

TEST_CASE("bodies in rows that can't be are an error that says what to write") {
  const std::string body = "[[body]]\nname = \"ball\"\nmesh = \"icosphere:1\"\n",
                    rows = body + "count = [2, 1, 1]\nspacing = [3, 0, 0]\n";
  check_input_error(body + "count = [2, 1, 1]\n", 1, {"has no spacing"});
  check_input_error(body + "spacing = [2, 1, 1]\n", 4, {"spacing", "count"});
  check_input_error(body + "counts = [2, 1, 1]\n", 4, {"counts", "unknown key", "count"});
  check_input_error(body + "count = [0, 1, 1]\nspacing = [3, 0, 0]\n", 4, {"count", "out of range"});
  check_input_error(body + "count = 2\nspacing = [3, 0, 0]\n", 4, {"count", "array of 3"});
  check_input_error(body + "count = [300, 300, 1]\nspacing = [3, 0, 0]\n", 4, {"makes 90000 bodies", "65535"});
  check_input_error(rows + "\"[2,0,0]\" = { scale = 2 }\n", 6, {"none of the bodies"});
  check_input_error(rows + "\"[1, 0, 0]\" = { scale = 2 }\n", 6, {"none of the bodies", "[0,0,0]"});
  check_input_error(rows + "\"[1,0,0]\" = 2\n", 6, {"is a whole number", "write a table"});
  check_input_error(rows + "\"[1,0,0]\" = { name = \"b\" }\n", 6, {"[1,0,0].name", "for all bodies"});
  check_input_error(rows + "\"[1,0,0]\" = { scal = 2 }\n", 6, {"body.ball[1,0,0].scal", "unknown key"});
  check_input_error(rows + "\"[1,0,0]\" = { stiffness = 2, total_stiffness = 2 }\n", 6, {"can't be combined"});
  check_input_error(rows + "scal = 2\n", 6, {"body.ball.scal", "unknown key", "scale"});
  check_input_error(body + "\"[0,0,0]\" = { scale = 2 }\n", 4, {"body.ball[0,0,0]", "count"});
  check_input_error(body + rows, 4, {"the name is taken"});
  check_input_error("[[body]]\nname = \"ball[1,0,0]\"\nmesh = \"icosphere:1\"\n" + rows, 4, {"the name is taken"});
}

}  // namespace
}  // namespace pliant
