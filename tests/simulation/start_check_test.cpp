// What contact by impulses needs of the start: bodies out of grounds and of each other, by a gap.
#include "simulation/start_check.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "device/cpu/cpu_device.hpp"
#include "model/load_bodies.hpp"
#include "scene/load_scene.hpp"
#include "simulation/overlap.hpp"
#include "simulation/start_gap.hpp"
#include "simulation/time_plan.hpp"
#include "support/evolve.hpp"
#include "support/expect_error.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

// A sphere of radius 1 at the origin, named "ball".
const std::string ball = "[[body]]\nname = \"ball\"\nmesh = \"icosphere:2\"\n";

class Start {
 public:
  explicit Start(const std::string& text)
      : scene_(parse_scene(text, "scene.toml", {})),
        start_(build_model(load_bodies(scene_), scene_.simulation.gravity, scene_.grounds)) {}

  void check(int precision = 32) {
    const auto device = make_cpu_device(1, precision);
    Simulation simulation(*device, start_.model, start_.state, plan_time(scene_, start_.model), scene_.collision);
    expect_apart(simulation, start_.model, scene_.collision, "scene.toml");
  }
  void check_going_on() {
    const auto device = make_cpu_device(1, 32);
    Simulation simulation(*device, start_.model, start_.state, plan_time(scene_, start_.model), scene_.collision);
    expect_still_apart(simulation, start_.model, scene_.collision, "scene.toml");
  }
  Error error() {
    return error_of([&] { check(); });
  }

  std::vector<std::string> told() const { return told_near_starts(start_.model, start_.state, scene_.collision); }
  // That bodies of one mesh keep [m].
  double gap() const { return gap_between(start_.model, start_.model.bodies[0], start_.model.bodies[0], scene_.collision); }

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

TEST_CASE("the way out of a ground leaves the gap that the scene asks for") {
  const std::string wide = "[collision]\ngap = 0.1\n[[ground]]\nheight = -0.5\n" + ball;
  const std::string told = fmt::format("which leaves {:.3g} m between them", Start(wide).gap());
  check_says(Start(wide).error(), {told.c_str()});
  CHECK(Start(wide).gap() == Approx(2 * Start(ball).gap()));
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

TEST_CASE("a body in a static one is the one to be moved, and zeros have no sign") {
  const Error inside = Start(ball + "[[body]]\nmesh = \"icosphere:2\"\nposition = [1.5, 0, 0]\nkind = \"static\"\n").error();
  check_says(inside, {"\"ball\" by [-0.51", ", 0, 0]"});
}

TEST_CASE("bodies far from the origin are apart if they are so in fp64") {
  const std::string far = "[[body]]\nmesh = \"icosphere:2\"\nposition = [1e8, 0, 0]\n";  // where floats are 8 m apart
  CHECK_NOTHROW(Start(far + "[[body]]\nmesh = \"icosphere:2\"\nposition = [100000003, 0, 0]\n").check());
  CHECK_THROWS_AS(Start(far + "[[body]]\nmesh = \"icosphere:2\"\nposition = [100000001.5, 0, 0]\n").check(), Error);
}

TEST_CASE("bodies far from the origin that intersect by less than floats tell there are named") {
  for (int k = 0; k < 20; ++k) {
    const double place = 3e5 + 0.01 * k;  // where floats are 3 cm apart
    const std::string text =
        ball + fmt::format("position = [{:.9f}, 0, 0]\n", place) +
        fmt::format("[[body]]\nname = \"other\"\nmesh = \"icosphere:2\"\nposition = [{:.9f}, 0, 0]\n", place + 1.998);
    CAPTURE(place);
    check_says(error_of([&] { Start(text).check(64); }), {"bodies \"ball\" and \"other\" intersect"});
  }
}

TEST_CASE("bodies in rows that intersect are told to have a larger spacing, and others are not") {
  const std::string rows = "[[body]]\nname = \"row\"\nmesh = \"icosphere:2\"\ncount = [2, 1, 1]\nspacing = [1.5, 0, 0]\n";
  check_says(error_of([&] { Start(rows).check(); }), {"\"row[0,0,0]\" and \"row[1,0,0]\"", "give their rows a larger spacing"});
  for (const char* name : {"other", "ball[left]", "ball[0,0,0"}) {
    const Error of_others = error_of([&] {
      Start(fmt::format("{}[[body]]\nname = \"{}\"\nmesh = \"icosphere:2\"\nposition = [1.5, 0, 0]\n", ball, name)).check();
    });
    CHECK_THAT(std::string(of_others.what()), !Catch::Contains("spacing"));
  }
}

// A second ball beside the first one, with its centre at this place. A corner of each is nearest to the other.
std::string two_balls(double place) {
  return ball + fmt::format("[[body]]\nname = \"other\"\nmesh = \"icosphere:2\"\nposition = [{:.16g}, 0, 0]\n", place);
}

// A second ball so many gaps from the first one.
std::string beside(double gaps) { return two_balls(2 + gaps * Start(ball).gap()); }

TEST_CASE("bodies that begin too near each other for proofs are an error, and higher precision is its remedy") {
  for (const double distance : {1e-12, 1e-9, 2e-7}) {
    CAPTURE(distance);
    Start start(two_balls(2 + distance));
    check_says(start.error(), {"bodies \"ball\" and \"other\" begin ", "too near to prove in fp32",
                               "move them further apart, or take --precision 64"});
    CHECK_NOTHROW(start.check(64));
  }
  CHECK_NOTHROW(Start(beside(0.01)).check());
  const Error in_fp64 = error_of([] { Start(two_balls(2.000000000000001)).check(64); });
  check_says(in_fp64, {"too near to prove in fp64", "move them further apart"});
  CHECK_THAT(std::string(in_fp64.what()), !Catch::Contains("--precision"));
  const Error in_rows =
      Start("[[body]]\nname = \"row\"\nmesh = \"icosphere:2\"\ncount = [2, 1, 1]\nspacing = [2.0000001, 0, 0]\n").error();
  check_says(in_rows, {"\"row[0,0,0]\" and \"row[1,0,0]\" begin ", "move them further apart, or take --precision 64"});
  CHECK_THAT(std::string(in_rows.what()), !Catch::Contains("spacing"));  // one of them may have a position of its own
}

TEST_CASE("bodies that have come too near each other for proofs go on, and stay apart, on every device", "[gl][long]") {
  const std::string text =
      "[[body]]\nmesh = \"icosphere:1\"\nvelocity = [1, 0, 0]\n"
      "[[body]]\nmesh = \"icosphere:1\"\nposition = [2.0000001, 0, 0]\nvelocity = [-1, 0, 0]\n";
  const SceneDescription scene = parse_scene(text, "scene.toml", {});
  const ModelAndState start = build_model(load_bodies(scene), scene.simulation.gravity, scene.grounds);
  for (const TestDevice& test : all_devices()) {
    CAPTURE(test.name);
    Simulation simulation(*test.device, start.model, start.state, plan_time(scene, start.model), scene.collision);
    if (simulation.precision() == 32)
      CHECK_THROWS_AS(expect_apart(simulation, start.model, scene.collision, "scene.toml"), Error);
    CHECK_NOTHROW(expect_still_apart(simulation, start.model, scene.collision, "scene.toml"));
    for (int k = 0; k < 5; ++k) {
      simulation.advance(20);
      CHECK(count_touching_pairs(start.model, simulation.state().world_positions(start.model)) == 0);
    }
    CHECK_FALSE(simulation.report().breakdown.has_value());
  }
}

TEST_CASE("bodies that intersect do not go on") {
  Start start(ball + "[[body]]\nname = \"other\"\nmesh = \"icosphere:2\"\nposition = [1.9, 0, 0]\n");
  check_says(error_of([&] { start.check_going_on(); }), {"bodies \"ball\" and \"other\" intersect"});
}

TEST_CASE("bodies that begin nearer than their gap are named, and those that keep it are not") {
  const std::vector<std::string> told = Start(beside(0.5)).told();
  REQUIRE(told.size() == 1);
  const double gap = Start(ball).gap();
  CHECK_THAT(told[0], Catch::Contains(fmt::format("bodies \"ball\" and \"other\" begin {:.3g} m apart", 0.5 * gap)) &&
                          Catch::Contains(fmt::format("the gap of {:.3g} m", gap)) && Catch::Contains("move them further apart"));
  CHECK(Start(beside(1)).told().empty());
  CHECK(Start("[collision]\ngap = 0.02\n" + beside(0.5)).told().empty());
  CHECK(Start("[collision]\ngap = 0.1\n" + beside(1)).told().size() == 1);
}

TEST_CASE("a body that begins inside a closed one is named, and one in a bowl or beside it is not") {
  const std::string small = "[[body]]\nname = \"small\"\nmesh = \"icosphere:1\"\nscale = 0.25\n";
  const std::vector<std::string> told = Start(small + ball).told();
  REQUIRE(told.size() == 1);
  CHECK_THAT(told[0], Catch::Contains("body \"small\" begins inside body \"ball\"") && Catch::Contains("move it out"));
  CHECK(Start(ball + small).told() == told);
  CHECK(Start(ball + small + "position = [0.8, 0.8, 0.8]\n").told().empty());  // in the ball's box
  const test::ScratchFolder folder;
  std::ofstream(folder.path / "bowl.obj")
      << "v -4 -1 -4\nv 4 -1 -4\nv 4 -1 4\nv -4 -1 4\nv -4 4 -4\nv 4 4 -4\nv 4 4 4\nv -4 4 4\n"
         "f 1 2 3\nf 1 3 4\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n";
  const std::string bowl =
      "[[body]]\nname = \"bowl\"\nkind = \"static\"\nmesh = \"" + (folder.path / "bowl.obj").string() + "\"\n";
  CHECK(Start(bowl + small).told().empty());
}

TEST_CASE("a body that begins nearer to a ground than the gap is named, with the ground's line") {
  const auto above = [](double gaps) {
    return fmt::format("[[ground]]\nheight = {:.9f}\n", -1 - gaps * Start(ball).gap()) + ball;
  };
  const std::vector<std::string> told = Start(above(0.25)).told();
  REQUIRE(told.size() == 1);
  CHECK_THAT(told[0], Catch::Contains("body \"ball\" and the ground of scene.toml:1: ground begin"));
  CHECK(Start(above(1)).told().empty());
}

TEST_CASE("of many bodies that begin too near eight pairs are named, and the rest counted") {
  std::string row;
  for (int k = 0; k < 12; ++k)
    row += fmt::format("[[body]]\nmesh = \"icosphere:2\"\nposition = [{:.9f}, 0, 0]\n", k * (2 + 0.5 * Start(ball).gap()));
  const std::vector<std::string> told = Start(row).told();
  REQUIRE(told.size() == 9);
  CHECK_THAT(told[8], Catch::StartsWith("3 more warnings of bodies that begin"));
}

}  // namespace
}  // namespace pliant
