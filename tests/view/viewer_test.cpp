// `pliant view` in a real window, driven through X by keys and mouse. Nothing here waits for a time: the program reports each
// picture, and a test reads until what it did shows.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "support/display.hpp"
#include "support/paths.hpp"
#include "support/pictures.hpp"
#include "support/program.hpp"
#include "support/scratch.hpp"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

using namespace pliant;
using namespace pliant::test;

namespace {

using Json = nlohmann::json;

constexpr const char* built_without = "built without the viewer";

// Two small spheres, one of them on its way to the other.
std::filesystem::path small_scene(const ScratchFolder& folder) {
  const auto file = folder.path / "small.toml";
  std::ofstream(file)
      << "title = \"Small\"\n[simulation]\ntime_step = 0.01\n[output]\nsize = [320, 240]\n"
         "[[body]]\nmesh = \"icosphere:1\"\nposition = [-1.3, 0, 0]\nvelocity = [0.5, 0, 0]\ncolor = [0.8, 0.1, 0.05]\n"
         "[[body]]\nmesh = \"icosphere:1\"\nposition = [1.3, 0, 0]\ncolor = [0.05, 0.1, 0.8]\n";
  return file;
}

glm::dvec3 place(const Json& json) { return {json[0], json[1], json[2]}; }
glm::dvec3 eye_from_target(const Json& line) { return place(line["camera"]["eye"]) - place(line["camera"]["target"]); }

bool has_turned_by_a_quarter(const Json& before, const Json& after) {
  const glm::dvec3 old = eye_from_target(before);
  return glm::distance(eye_from_target(after), glm::dvec3(-old.z, old.y, old.x)) < 1e-6 * glm::length(old);
}

render::Image load_png(const std::filesystem::path& file) {
  int width = 0, height = 0, channels = 0;
  stbi_uc* pixels = stbi_load(file.c_str(), &width, &height, &channels, 3);
  REQUIRE(pixels != nullptr);
  render::Image image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  image.pixels.assign(pixels, pixels + 3 * width * height);
  stbi_image_free(pixels);
  return image;
}

std::vector<std::string> command(const std::filesystem::path& scene, const std::string& device,
                                 const std::vector<std::string>& more) {
  std::vector<std::string> command = {
      "sh",       "-c",         "exec \"$0\" \"$@\" 2>&1", program_path(), "view", scene.string(), "--paused", "--device", device,
      "--report", "/dev/stdout"};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

/// The program in its window. Leaks are not looked for: the driver's libraries leave some when they are unloaded with the window,
/// after which no suppression knows their names.
class Viewed {
 public:
  Viewed(const VirtualDisplay& display, const ScratchFolder& folder, const std::string& device,
         const std::vector<std::string>& more = {})
      : display_(display),
        folder_(folder.path),
        program_(command(small_scene(folder), device, more),
                 {{"DISPLAY", display.name()}, {"LIBGL_ALWAYS_SOFTWARE", "1"}, {"ASAN_OPTIONS", "detect_leaks=0"}}, folder.path) {
    await([](const Json&) { return true; });
    window_ = display.run("xdotool search --sync --onlyvisible --name 'Small - pliant'");
    window_.erase(window_.find_last_not_of('\n') + 1);
    xdotool("windowfocus --sync " + window_);
  }

  /// Runs commands of it.
  void xdotool(const std::string& commands) const { (void)display_.run("xdotool " + commands); }
  [[nodiscard]] std::string move_to(const glm::ivec2& at) const {
    return "mousemove --window " + window_ + " " + std::to_string(at.x) + " " + std::to_string(at.y) + " ";
  }
  void press(const std::string& key) const { xdotool("key " + key); }
  void drag(int button, const glm::ivec2& from, const glm::ivec2& to) const {
    xdotool(move_to(from) + "mousedown " + std::to_string(button) + " " + move_to(to) + "mouseup " + std::to_string(button));
  }
  void click(const glm::ivec2& at) const { xdotool(move_to(at) + "click 1"); }
  void drop(const std::filesystem::path& file) const { display_.drop(file, window_); }
  /// Reads reports until one is as wanted, for two minutes at most.
  Json await(const std::function<bool(const Json&)>& is_wanted) {
    const auto began = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - began < std::chrono::minutes(2)) {
      const std::string line = program_.read_line();
      if (!line.starts_with('{')) continue;
      if (const Json report = Json::parse(line); is_wanted(report)) return report;
    }
    throw std::runtime_error("no picture was as wanted");
  }
  std::string await_text(const std::string& beginning) {
    for (;;)
      if (std::string line = program_.read_line(); line.starts_with(beginning)) return line;
  }
  /// The picture that the program saves.
  render::Image saved_picture() {
    press("F12");
    const std::string line = await_text("saved ");
    return load_png(folder_ / line.substr(6));
  }
  /// Whether the window shows the picture; it may still be on its way to the display.
  bool shows(const render::Image& picture) const {
    for (int look = 0; look < 200; ++look)
      if (const render::Image seen = display_.picture_of(window_); seen.width == picture.width && are_alike(seen, picture))
        return true;
    return false;
  }
  bool shows_another(const render::Image& picture) const {
    for (int look = 0; look < 200; ++look)
      if (!are_alike(display_.picture_of(window_), picture)) return true;
    return false;
  }
  const std::string& window() const { return window_; }
  Child& program() { return program_; }

 private:
  const VirtualDisplay& display_;
  std::filesystem::path folder_;
  Child program_;
  std::string window_;  // its number
};

auto step_is(std::uint64_t step) {
  return [step](const Json& line) { return line["step"] == step; };
}
auto size_is(unsigned width, unsigned height) {
  return [=](const Json& line) { return line["size"] == Json{width, height}; };
}

// The pixels of the red body: how many there are, and where they are on average.
struct Reddish {
  explicit Reddish(const render::Image& image) {
    for (std::size_t i = 0; i < image.pixels.size() / 3; ++i) {
      if (image.pixels[3 * i] <= 2 * image.pixels[3 * i + 2]) continue;
      ++count;
      sum += glm::dvec2(i % image.width, i / image.width);
    }
  }
  [[nodiscard]] glm::ivec2 centre() const { return sum / static_cast<double>(count); }
  long count = 0;
  glm::dvec2 sum{0.0};
};

void check_playing(Viewed& viewed) {
  const render::Image first = viewed.saved_picture();
  CHECK(Reddish(first).count > 1000);
  CHECK(viewed.shows(first));
  for (const std::uint64_t step : {1, 2, 3}) {
    viewed.press("period");
    CHECK(viewed.await(step_is(step))["time"] == Approx(0.01 * static_cast<double>(step)));
  }
  const render::Image third = viewed.saved_picture();
  CHECK_FALSE(are_alike(third, first));
  viewed.press("comma");
  viewed.await(step_is(2));
  viewed.press("period");
  viewed.await(step_is(3));
  CHECK(are_alike(viewed.saved_picture(), third));

  viewed.press("space");
  const Json playing = viewed.await([](const Json& line) { return !line["paused"] && line["step"] > 3; });
  viewed.await([&](const Json& line) { return line["step"] > playing["step"]; });
  viewed.press("space");
  const Json paused = viewed.await([](const Json& line) { return line["paused"].get<bool>(); });
  CHECK_THAT(paused["title"].get<std::string>(), Catch::Contains("paused"));
  viewed.press("comma");
  viewed.await(step_is(paused["step"].get<std::uint64_t>() - 1));
  viewed.press("r");
  viewed.await(step_is(0));
  CHECK(are_alike(viewed.saved_picture(), first));
  CHECK(viewed.shows(first));
}

void check_camera(Viewed& viewed) {
  Json before = viewed.await([](const Json&) { return true; });
  viewed.drag(1, {100, 100}, {180, 100});  // a quarter of the window's width
  before = viewed.await([&](const Json& line) { return has_turned_by_a_quarter(before, line); });
  viewed.xdotool("click 4");
  const auto is_nearer = [&](const Json& line) {
    return std::abs(glm::length(eye_from_target(line)) - 0.9 * glm::length(eye_from_target(before))) < 1e-9;
  };
  before = viewed.await(is_nearer);
  viewed.drag(3, {100, 100}, {130, 90});
  const auto has_shifted = [&](const Json& line) {
    return line["camera"]["target"] != before["camera"]["target"] &&
           glm::distance(eye_from_target(line), eye_from_target(before)) < 1e-9;
  };
  viewed.await(has_shifted);
  const render::Image surface = viewed.saved_picture();
  CHECK(viewed.shows(surface));
  viewed.press("w");
  viewed.await([](const Json& line) { return line["wireframe"].get<bool>(); });
  CHECK_FALSE(are_alike(viewed.saved_picture(), surface));
  viewed.press("w");
  viewed.await([](const Json& line) { return !line["wireframe"]; });
  CHECK(are_alike(viewed.saved_picture(), surface));
  viewed.press("f");
  viewed.await([](const Json& line) { return glm::length(place(line["camera"]["target"])) < 1e-6; });
}

void check_window(Viewed& viewed) {
  viewed.xdotool("windowsize " + viewed.window() + " 402 301");
  viewed.await(size_is(402, 301));
  const render::Image resized = viewed.saved_picture();
  CHECK(resized.width == 402);
  CHECK(resized.height == 301);
  CHECK(viewed.shows(resized));

  viewed.press("space");
  viewed.await([](const Json& line) { return !line["paused"]; });
  viewed.xdotool("windowminimize " + viewed.window());
  const Json minimised = viewed.await(size_is(0, 0));
  viewed.await([&](const Json& line) { return line["step"] > minimised["step"]; });
  viewed.xdotool("windowactivate --sync " + viewed.window());
  viewed.await(size_is(402, 301));
  viewed.press("alt+F4");
  CHECK(viewed.program().wait_for_end() == 0);
}

/// Why no window can be tested here; empty where it can.
std::string obstacle() {
  const ProgramResult result = run_program("view " + shipped_scene("two_spheres"), "env -u DISPLAY -u WAYLAND_DISPLAY ");
  if (result.output.find(built_without) != std::string::npos) return "this program was built without the viewer";
  const std::string missing = VirtualDisplay::missing();
  REQUIRE((missing.empty() || std::getenv("CI") == nullptr));
  return missing.empty() ? "" : "there is no " + missing;
}

bool is_skipped() {
  const std::string why = obstacle();
  if (!why.empty()) WARN("skipped: " << why);
  return !why.empty();
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
  const Json kept =
      viewed.await([](const Json& line) { return line["title"].get<std::string>().find("bad.obj") != std::string::npos; });
  CHECK_THAT(kept["scene"].get<std::string>(), Catch::EndsWith("small.toml"));
  CHECK(are_alike(viewed.saved_picture(), before));

  viewed.drop(source_dir() + "/meshes/teapot.obj");
  viewed.await([](const Json& line) { return line["title"].get<std::string>().starts_with("teapot"); });
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
    const Json pulled = viewed.await([](const Json& line) { return line["pulls"].get<bool>(); });
    viewed.await([&](const Json& line) { return line["time"] > pulled["time"].get<double>() + 0.5; });
    CHECK(Reddish(viewed.saved_picture()).centre().y < before.y - 10);
    viewed.xdotool("mouseup 1");
    const Json released = viewed.await([](const Json& line) { return !line["pulls"]; });
    CHECK(released["camera"] == pulled["camera"]);

    viewed.press("space");
    viewed.await([](const Json& line) { return line["paused"].get<bool>(); });
    const render::Image here = viewed.saved_picture();
    viewed.press("d");
    const Json moved = viewed.await([&](const Json& line) { return line["device"] != device; });
    CHECK(are_alike(viewed.saved_picture(), here));
    viewed.press("period");
    viewed.await(step_is(moved["step"].get<std::uint64_t>() + 1));
    viewed.press("d");
    viewed.await([&](const Json& line) { return line["device"] == device; });
  }
}

TEST_CASE("the panel and the help come and go, and what happens over them leaves the scene alone", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  for (const char* device : {"cpu", "gpu"}) {
    CAPTURE(device);
    const ScratchFolder folder;
    Viewed viewed(display, folder, device);
    const render::Image alone = viewed.saved_picture();
    viewed.press("Tab");
    const Json with_panel = viewed.await([](const Json& line) { return line["panel"].get<bool>(); });
    CHECK(viewed.shows_another(alone));
    viewed.drag(1, {60, 100}, {150, 120});
    viewed.xdotool("click 5");
    viewed.press("period");
    const Json after = viewed.await(step_is(1));
    CHECK(after["camera"] == with_panel["camera"]);
    viewed.press("comma");
    viewed.await(step_is(0));
    viewed.press("Tab");
    viewed.press("F1");
    viewed.await([](const Json& line) { return !line["panel"] && line["help"]; });
    viewed.press("F1");
    viewed.await([](const Json& line) { return !line["help"]; });
    CHECK(viewed.shows(alone));
    CHECK(are_alike(viewed.saved_picture(), alone));
  }
}

// Where the panel has its widgets, in rows above all that wraps.
constexpr glm::ivec2 scene_list(120, 46), first_in_list(60, 70), play_button(48, 70), back_button(93, 70), step_button(116, 70),
    reset_button(153, 70), gpu_button(240, 70), speed_slider(100, 92);
constexpr glm::ivec2 farther_right(40, 0);

TEST_CASE("the panel's buttons do what keys do, and its list opens the scenes beside", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  std::ofstream(folder.path / "another.toml") << "[[body]]\nmesh = \"icosphere:1\"\n";
  Viewed viewed(display, folder, "cpu");
  viewed.press("Tab");
  viewed.await([](const Json& line) { return line["panel"].get<bool>(); });
  viewed.click(step_button);
  viewed.await(step_is(1));
  viewed.click(step_button);
  viewed.await(step_is(2));
  viewed.click(back_button);
  viewed.await(step_is(1));
  viewed.click(gpu_button);
  viewed.await([](const Json& line) { return line["device"] == "gpu"; });
  viewed.click(play_button);
  viewed.await([](const Json& line) { return !line["paused"] && line["step"] > 1; });
  viewed.click(play_button);
  viewed.await([](const Json& line) { return line["paused"].get<bool>(); });
  viewed.click(reset_button);
  viewed.await(step_is(0));
  viewed.click(scene_list);
  viewed.await([](const Json&) { return true; });
  viewed.click(first_in_list);
  const Json opened = viewed.await([](const Json& line) { return !line["scene"].get<std::string>().ends_with("small.toml"); });
  CHECK_THAT(opened["scene"].get<std::string>(), Catch::EndsWith("another.toml"));
  CHECK(opened["panel"].get<bool>());
}

TEST_CASE("a widget that is held when the panel goes is let go by the mouse, whether the panel is back or not", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.press("Tab");
  const Json before = viewed.await([](const Json& line) { return line["panel"].get<bool>(); });
  viewed.xdotool(viewed.move_to(speed_slider) + "mousedown 1");
  const Json pressed = viewed.await([](const Json& line) { return line["speed"] != 1; });
  viewed.xdotool(viewed.move_to(speed_slider + farther_right));
  const Json held = viewed.await([&](const Json& line) { return line["speed"] > pressed["speed"].get<double>(); });
  viewed.press("Tab");
  viewed.await([](const Json& line) { return !line["panel"]; });
  viewed.xdotool(viewed.move_to(speed_slider) + "mouseup 1 key Tab " + viewed.move_to(speed_slider + 2 * farther_right));
  for (std::uint64_t step = 1; step <= 4; ++step) {  // a few pictures
    viewed.press("period");
    const Json after = viewed.await(step_is(step));
    CHECK(after["panel"].get<bool>());
    CHECK(after["speed"] == held["speed"]);
    CHECK(after["camera"] == before["camera"]);
  }
}

TEST_CASE("what was told of a breakdown is gone when the panel goes back to the start", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu", {"--set", "simulation.time_step=1e30", "--set", "body.body1.stretch=[0.8, 1, 1]"});
  viewed.press("Tab");
  viewed.await([](const Json& line) { return line["panel"].get<bool>(); });
  viewed.press("period");
  CHECK_THAT(viewed.await(step_is(1))["message"].get<std::string>(), Catch::Contains("non-finite"));
  viewed.click(reset_button);
  const Json restarted = viewed.await(step_is(0));
  CHECK(restarted["message"] == "");
  CHECK(restarted["title"] == "Small - pliant (paused at 0 s)");
}

TEST_CASE("what happens over the help leaves the scene alone, and beside it does not", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu", {"--set", "output.size=[800, 300]"});
  viewed.press("Tab");
  viewed.await([](const Json& line) { return line["panel"].get<bool>(); });
  viewed.press("Tab");
  viewed.press("F1");
  const Json before = viewed.await([](const Json& line) { return !line["panel"] && line["help"]; });
  viewed.drag(1, {700, 100}, {650, 120});
  viewed.xdotool("click 5");
  viewed.drag(1, {60, 100}, {260, 100});  // where the panel was, by a quarter of the width
  viewed.await([&](const Json& line) { return has_turned_by_a_quarter(before, line); });
}

TEST_CASE("on a dense display the panel is larger", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  display.make_dense();
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.press("Tab");
  const Json before = viewed.await([](const Json& line) { return line["panel"].get<bool>(); });
  CHECK(before["size"] == Json{640, 480});
  viewed.click(2 * step_button);
  viewed.await(step_is(1));
}

TEST_CASE("a key that is held ends its work when it is let go, and only steps repeat", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.xdotool("keydown period");
  viewed.await([](const Json& line) { return line["step"] > 3; });
  viewed.xdotool("keyup period key w");
  const Json after = viewed.await([](const Json& line) { return line["wireframe"].get<bool>(); });
  viewed.xdotool("keydown w");  // would flip back and forth
  viewed.await([](const Json& line) { return !line["wireframe"]; });
  viewed.xdotool("sleep 1 keyup w key period");
  const Json last = viewed.await(step_is(after["step"].get<std::uint64_t>() + 1));
  CHECK_FALSE(last["wireframe"]);
}

TEST_CASE("a key does what the layout writes by it, and nothing beside Ctrl", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.press("ctrl+w");
  viewed.press("period");
  CHECK_FALSE(viewed.await(step_is(1))["wireframe"]);
  (void)display.run("setxkbmap fr");
  viewed.press("period");  // Shift and another key there
  viewed.await(step_is(2));
  (void)display.run("setxkbmap ru");
  viewed.press("Cyrillic_tse");  // where W is in a Latin layout
  viewed.await([](const Json& line) { return line["wireframe"].get<bool>(); });
}

TEST_CASE("a step that goes non-finite is told at once", "[gl]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu", {"--set", "simulation.time_step=1e30", "--set", "body.body1.stretch=[0.8, 1, 1]"});
  viewed.press("period");
  CHECK_THAT(viewed.await_text("pliant: the simulation became"), Catch::Contains("at vertex"));
  CHECK_THAT(viewed.await(step_is(1))["title"].get<std::string>(), Catch::Contains("non-finite"));
}

TEST_CASE("mistakes need no display to be seen") {
  const std::string without = "env -u DISPLAY -u WAYLAND_DISPLAY ";
  const ProgramResult contradiction =
      run_program("view " + shipped_scene("two_spheres") + " --device gpu --precision 64", without);
  const ProgramResult overridden = run_program("view " + source_dir() + "/meshes/teapot.obj --set a.b=1", without);
  if (contradiction.output.find(built_without) != std::string::npos) return;
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
