// `pliant view` in a real window, driven by keys and mouse.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "scene/load_scene.hpp"
#include "support/has.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"
#include "support/viewed.hpp"

using namespace pliant;
using namespace pliant::test;

namespace {

void check_playing(Viewed& viewed) {
  const render::Image first = viewed.saved_picture();
  CHECK(Reddish(first).count > 1000);
  CHECK(viewed.shows(first));
  for (const std::uint64_t step : {1, 2, 3}) {
    viewed.press("period");
    CHECK(viewed.await(step_is(step))["time"].get<double>() == Approx(0.01 * static_cast<double>(step)));
  }
  const render::Image third = viewed.saved_picture();
  CHECK_FALSE(are_alike(third, first));
  viewed.press("comma");
  viewed.await(step_is(2));
  viewed.press("period");
  viewed.await(step_is(3));
  CHECK(are_alike(viewed.saved_picture(), third));

  viewed.press("space");
  const ReadJson playing = viewed.await([](const ReadJson& line) { return !line["paused"].get<bool>() && line["step"] > 3; });
  viewed.await([&](const ReadJson& line) { return line["step"] > playing["step"]; });
  viewed.press("space");
  const ReadJson paused = viewed.await([](const ReadJson& line) { return line["paused"].get<bool>(); });
  CHECK_THAT(paused["title"].get<std::string>(), Catch::Contains("paused"));
  viewed.press("comma");
  viewed.await(step_is(paused["step"].get<std::uint64_t>() - 1));
  viewed.press("r");
  viewed.await(step_is(0));
  CHECK(are_alike(viewed.saved_picture(), first));
  CHECK(viewed.shows(first));
}

void check_camera(Viewed& viewed) {
  ReadJson before = viewed.await([](const ReadJson&) { return true; });
  viewed.drag(1, {100, 100}, {180, 100});  // a quarter of the window's width
  before = viewed.await([&](const ReadJson& line) { return has_turned_by_a_quarter(before, line); });
  viewed.xdotool("click 4");
  const auto is_nearer = [&](const ReadJson& line) {
    return std::abs(glm::length(eye_from_target(line)) - 0.9 * glm::length(eye_from_target(before))) < 1e-9;
  };
  before = viewed.await(is_nearer);
  viewed.drag(3, {100, 100}, {130, 90});
  const auto has_shifted = [&](const ReadJson& line) {
    return line["camera"]["target"] != before["camera"]["target"] &&
           glm::distance(eye_from_target(line), eye_from_target(before)) < 1e-9;
  };
  viewed.await(has_shifted);
  const render::Image surface = viewed.saved_picture();
  CHECK(viewed.shows(surface));
  viewed.press("w");
  viewed.await([](const ReadJson& line) { return line["wireframe"].get<bool>(); });
  CHECK_FALSE(are_alike(viewed.saved_picture(), surface));
  viewed.press("w");
  viewed.await([](const ReadJson& line) { return !line["wireframe"].get<bool>(); });
  CHECK(are_alike(viewed.saved_picture(), surface));
  viewed.press("f");
  viewed.await([](const ReadJson& line) { return glm::length(place(line["camera"]["target"])) < 1e-6; });
}

void check_window(Viewed& viewed) {
  viewed.xdotool("windowsize " + viewed.window() + " 402 301");
  viewed.await(size_is(402, 301));
  const render::Image resized = viewed.saved_picture();
  CHECK(resized.width == 402);
  CHECK(resized.height == 301);
  CHECK(viewed.shows(resized));

  viewed.press("space");
  viewed.await([](const ReadJson& line) { return !line["paused"].get<bool>(); });
  viewed.xdotool("windowminimize " + viewed.window());
  const ReadJson minimised = viewed.await(size_is(0, 0));
  viewed.await([&](const ReadJson& line) { return line["step"] > minimised["step"]; });
  viewed.xdotool("windowactivate --sync " + viewed.window());
  viewed.await(size_is(402, 301));
  viewed.press("alt+F4");
  CHECK(viewed.program().wait_for_end() == 0);
}

TEST_CASE("without a display the viewer says so, and what to do instead") {
  const ProgramResult result = run_program("view " + shipped_scene("two_spheres"), "env -u DISPLAY -u WAYLAND_DISPLAY ");
  CHECK(result.exit_code == 4);
  CHECK_THAT(result.output, Catch::Contains("no display") || Catch::Contains(built_without));
  CHECK_THAT(result.output, Catch::Contains("pliant run"));
}

TEST_CASE("a window plays, steps, goes back, turns, resizes, is minimised and closes, on either device", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  for (const char* device : {"cpu", "gpu"}) {
    CAPTURE(device);
    const ScratchFolder folder;
    Viewed viewed(display, folder, device);
    check_playing(viewed);
    check_camera(viewed);
    check_window(viewed);
  }
}

TEST_CASE("keys throw a ball, remove a body, and bring a hand that goes with the mouse", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  const auto bodies_are = [](std::size_t count) { return [count](const ReadJson& line) { return line["bodies"] == count; }; };
  const render::Image first = viewed.saved_picture();
  viewed.xdotool(viewed.move_to({160, 20}));
  viewed.press("b");
  viewed.await(bodies_are(3));
  const render::Image with_ball = viewed.saved_picture();
  CHECK_FALSE(are_alike(with_ball, first));
  CHECK(viewed.shows(with_ball));
  viewed.press("r");
  viewed.await(bodies_are(2));
  CHECK(are_alike(viewed.saved_picture(), first));
  CHECK(viewed.shows(first));
  viewed.press("h");
  viewed.await([](const ReadJson& line) { return line["hand"].get<bool>() && line["bodies"] == 3; });
  viewed.press("h");
  viewed.await([](const ReadJson& line) { return !line["hand"].get<bool>() && line["bodies"] == 2; });
  const auto says = [](const char* what) {
    return [what](const ReadJson& line) { return line["message"].get<std::string>().find(what) != std::string::npos; };
  };
  viewed.press("x");
  viewed.await(says("no body under the mouse"));
  viewed.press("s");
  viewed.await(says("no container"));
  viewed.xdotool(viewed.move_to({90, 120}));
  viewed.press("x");
  viewed.await(bodies_are(1));
  viewed.xdotool(viewed.move_to({230, 120}));
  viewed.press("x");
  viewed.await(says("last soft body"));
}

TEST_CASE("a scene is saved as it is, and a folder that is gone costs nothing", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.xdotool(viewed.move_to({160, 20}));
  viewed.press("b");
  viewed.await([](const ReadJson& line) { return line["bodies"] == 3; });
  viewed.press("period");
  viewed.await(step_is(1));
  viewed.press("F11");
  const std::string said = viewed.await_text("saved ");
  const ReadJson shown = viewed.await([](const ReadJson& line) { return line["message"] == "saved small_0000.toml"; });
  const SceneDescription saved = load_scene(folder.path / said.substr(6));
  REQUIRE(saved.bodies.size() == 3);
  CHECK((saved.title == "Small" && saved.bodies[2].name == "thrown 1"));
  CHECK(saved.bodies[0].position.x == Approx(-1.3 + 0.005));
  CHECK(saved.output.camera->eye == place(shown["camera"]["eye"]));
  CHECK(saved.output.ground_height.value() == Approx(-1).margin(0.1));  // just below the bodies at the start
  std::filesystem::remove_all(folder.path);
  viewed.press("F11");
  CHECK_THAT(viewed.await_text("pliant: "), Catch::Contains("small_0000.toml"));
  viewed.press("period");
  CHECK(viewed.await(step_is(2))["bodies"] == 3);
}

TEST_CASE("a scene that would not open as it is saved is saved, and the viewer says why", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu", {"--set", "body.body0.velocity=[8, 0, 0]"});
  for (std::uint64_t step = 1; step <= 15; ++step) {  // until one presses into the other
    viewed.press("period");
    viewed.await(step_is(step));
  }
  viewed.press("F11");
  viewed.await_text("saved small_0000.toml");
  CHECK_THAT(viewed.await_text("pliant: "), Catch::Contains("can't be opened") && Catch::Contains("intersect"));
  CHECK(load_scene(folder.path / "small_0000.toml").bodies.size() == 2);
  viewed.press("period");
  viewed.await(step_is(16));
}

TEST_CASE("without a scene a page of demos opens, and a click opens one", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Child program(
      {"sh", "-c", "exec \"$0\" \"$@\" 2>&1", program_path(), "view", "--paused", "--device", "cpu", "--report", "/dev/stdout"},
      {{"DISPLAY", display.name()}, {"LIBGL_ALWAYS_SOFTWARE", "1"}, {"ASAN_OPTIONS", "detect_leaks=0"}}, source_dir());
  const auto await = [&](const std::string& what) {
    std::string line;
    while (line.find(what) == std::string::npos) line = program.read_line();
    return line;
  };
  await("\"start_page\"");
  std::string window = display.run("xdotool search --sync --onlyvisible --name pliant | head -1");
  window.erase(window.find_last_not_of('\n') + 1);
  (void)display.run("xdotool windowfocus --sync " + window + " mousemove --window " + window + " 150 150");
  await("\"start_page\"");
  (void)display.run("xdotool click 1");
  CHECK_THAT(await("\"scene\""), Catch::Contains("scenes/demos/ball_pit.toml"));
  (void)display.run("xdotool windowfocus --sync " + window + " key Escape");
  CHECK(program.wait_for_end() == 0);
}

TEST_CASE("a file dropped on the window is opened, and a bad one leaves the scene as it is", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  const render::Image before = viewed.saved_picture();
  const auto bad = folder.path / "bad.obj";
  std::ofstream(bad) << "no mesh\n";
  viewed.drop(bad);
  CHECK_THAT(viewed.await_text("pliant: "), Catch::Contains("bad.obj"));
  const ReadJson kept =
      viewed.await([](const ReadJson& line) { return line["title"].get<std::string>().find("bad.obj") != std::string::npos; });
  CHECK_THAT(kept["scene"].get<std::string>(), Catch::EndsWith("small.toml"));
  CHECK(are_alike(viewed.saved_picture(), before));

  const auto overlapping = folder.path / "overlapping.toml";
  std::ofstream(overlapping) << "[[body]]\nmesh = \"icosphere:1\"\n"
                                "[[body]]\nmesh = \"icosphere:1\"\nposition = [1.5, 0, 0]\n";
  viewed.drop(overlapping);
  CHECK_THAT(viewed.await_text("pliant: "), Catch::Contains("\"body0\" and \"body1\" intersect"));
  viewed.await([](const ReadJson& line) { return line["message"].get<std::string>().find("intersect") != std::string::npos; });
  CHECK(are_alike(viewed.saved_picture(), before));

  viewed.drop(source_dir() + "/meshes/teapot.obj");
  viewed.await([](const ReadJson& line) { return line["title"].get<std::string>().starts_with("teapot"); });
  const render::Image teapot = viewed.saved_picture();
  CHECK_FALSE(are_alike(teapot, before));
  CHECK(viewed.shows(teapot));
}

TEST_CASE("Ctrl and the mouse pull a body, and D moves the scene to the other device and back", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  for (const std::string device : {"cpu", "gpu"}) {
    CAPTURE(device);
    const ScratchFolder folder;
    Viewed viewed(display, folder, device);
    const glm::ivec2 before = Reddish(viewed.saved_picture()).centre();
    viewed.press("space");
    viewed.xdotool("keydown ctrl " + viewed.move_to(before) + "mousedown 1 " + viewed.move_to(before - glm::ivec2(0, 40)) +
                   "keyup ctrl");
    const ReadJson pulled = viewed.await([](const ReadJson& line) { return line["pulls"].get<bool>(); });
    viewed.await([&](const ReadJson& line) { return line["time"] > pulled["time"].get<double>() + 0.5; });
    CHECK(Reddish(viewed.saved_picture()).centre().y < before.y - 10);
    viewed.xdotool("mouseup 1");
    const ReadJson released = viewed.await([](const ReadJson& line) { return !line["pulls"].get<bool>(); });
    CHECK(released["camera"] == pulled["camera"]);

    viewed.press("space");
    viewed.await([](const ReadJson& line) { return line["paused"].get<bool>(); });
    const render::Image here = viewed.saved_picture();
    viewed.press("d");
    const ReadJson moved = viewed.await([&](const ReadJson& line) { return line["device"] != device; });
    CHECK(are_alike(viewed.saved_picture(), here));
    viewed.press("period");
    viewed.await(step_is(moved["step"].get<std::uint64_t>() + 1));
    viewed.press("d");
    viewed.await([&](const ReadJson& line) { return line["device"] == device; });
  }
}

TEST_CASE("a key that is held ends its work when it is let go, and only steps repeat", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.xdotool("keydown period");
  viewed.await([](const ReadJson& line) { return line["step"] > 3; });
  viewed.xdotool("keyup period key w");
  const ReadJson after = viewed.await([](const ReadJson& line) { return line["wireframe"].get<bool>(); });
  viewed.xdotool("keydown w");  // would flip back and forth
  viewed.await([](const ReadJson& line) { return !line["wireframe"].get<bool>(); });
  viewed.xdotool("sleep 1 keyup w key period");
  const ReadJson last = viewed.await(step_is(after["step"].get<std::uint64_t>() + 1));
  CHECK_FALSE(last["wireframe"].get<bool>());
}

TEST_CASE("a key does what the layout writes by it, and nothing beside Ctrl", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.press("ctrl+w");
  viewed.press("period");
  CHECK_FALSE(viewed.await(step_is(1))["wireframe"].get<bool>());
  (void)display.run("setxkbmap fr");
  viewed.press("period");  // Shift and another key there
  viewed.await(step_is(2));
  (void)display.run("setxkbmap ru");
  viewed.press("Cyrillic_tse");  // where W is in a Latin layout
  viewed.await([](const ReadJson& line) { return line["wireframe"].get<bool>(); });
}

TEST_CASE("a step that goes non-finite is told at once", "[gl]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(
      display, folder, "cpu",
      {"--set", "simulation.time_step=1e30", "--set", "collision.response=reflect", "--set", "body.body1.stretch=[0.8, 1, 1]"});
  viewed.press("period");
  CHECK_THAT(viewed.await_text("pliant: the simulation became"), Catch::Contains("at vertex"));
  CHECK_THAT(viewed.await(step_is(1))["title"].get<std::string>(), Catch::Contains("non-finite"));
}

TEST_CASE("mistakes need no display to be seen") {
  const std::string without = "env -u DISPLAY -u WAYLAND_DISPLAY ";
  const ProgramResult contradiction =
      run_program("view " + shipped_scene("two_spheres") + " --device gpu --precision 64", without);
  const ProgramResult overridden = run_program("view " + source_dir() + "/meshes/teapot.obj --set a.b=1", without);
  if (contradiction.output.find(built_without) != std::string::npos) return test::skip(built_without);
  CHECK(contradiction.exit_code == 2);
  CHECK(overridden.exit_code == 2);
}

TEST_CASE("the escape key ends the viewer", "[gl]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.press("Escape");
  CHECK(viewed.program().wait_for_end() == 0);
}

}  // namespace
