// The viewer's panel and help, driven by keys and mouse.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "support/paths.hpp"
#include "support/viewed.hpp"

using namespace pliant;
using namespace pliant::test;

namespace {

TEST_CASE("the panel and the help come and go, and what happens over them leaves the scene alone", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  for (const char* device : {"cpu", "gpu"}) {
    CAPTURE(device);
    const ScratchFolder folder;
    Viewed viewed(display, folder, device);
    const render::Image alone = viewed.saved_picture();
    viewed.press("Tab");
    const ReadJson with_panel = viewed.await([](const ReadJson& line) { return line["panel"].get<bool>(); });
    CHECK(viewed.shows_another(alone));
    viewed.drag(1, {60, 100}, {150, 120});
    viewed.xdotool("click 5");
    viewed.press("period");
    const ReadJson after = viewed.await(step_is(1));
    CHECK(after["camera"] == with_panel["camera"]);
    viewed.press("comma");
    viewed.await(step_is(0));
    viewed.press("Tab");
    viewed.press("F1");
    viewed.await([](const ReadJson& line) { return !line["panel"].get<bool>() && line["help"].get<bool>(); });
    viewed.press("F1");
    viewed.await([](const ReadJson& line) { return !line["help"].get<bool>(); });
    CHECK(viewed.shows(alone));
    CHECK(are_alike(viewed.saved_picture(), alone));
  }
}

// Where the panel has its widgets. Their rows stand above all that wraps.
constexpr glm::ivec2 scene_list(120, 46), save_button(300, 46), first_in_list(60, 70), play_button(48, 70), back_button(93, 70),
    step_button(116, 70), reset_button(153, 70), gpu_button(240, 70), speed_slider(100, 92);
constexpr glm::ivec2 farther_right(40, 0);

TEST_CASE("the panel's buttons do what keys do, and its list opens the scenes beside", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  std::ofstream(folder.path / "another.toml") << "[[body]]\nmesh = \"icosphere:1\"\n";
  Viewed viewed(display, folder, "cpu");
  viewed.press("Tab");
  viewed.await([](const ReadJson& line) { return line["panel"].get<bool>(); });
  viewed.click(step_button);
  viewed.await(step_is(1));
  viewed.click(step_button);
  viewed.await(step_is(2));
  viewed.click(back_button);
  viewed.await(step_is(1));
  viewed.click(gpu_button);
  viewed.await([](const ReadJson& line) { return line["device"] == "gpu"; });
  viewed.click(play_button);
  viewed.await([](const ReadJson& line) { return !line["paused"].get<bool>() && line["step"] > 1; });
  viewed.click(play_button);
  viewed.await([](const ReadJson& line) { return line["paused"].get<bool>(); });
  viewed.click(reset_button);
  viewed.await(step_is(0));
  viewed.click(save_button);
  CHECK(viewed.await_text("saved ") == "saved small_0000.toml");
  CHECK(std::filesystem::remove(folder.path / "small_0000.toml"));
  viewed.click(scene_list);
  viewed.await([](const ReadJson& line) { return line["windows"] == 2; });
  viewed.click(first_in_list);
  const ReadJson opened =
      viewed.await([](const ReadJson& line) { return !line["scene"].get<std::string>().ends_with("small.toml"); });
  CHECK_THAT(opened["scene"].get<std::string>(), Catch::EndsWith("another.toml"));
  CHECK(opened["panel"].get<bool>());
}

TEST_CASE("a number can be typed into the panel, and keys are the viewer's again after it", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.press("Tab");
  viewed.await([](const ReadJson& line) { return line["panel"].get<bool>(); });
  viewed.xdotool(viewed.move_to(speed_slider) + "keydown Control_L click 1 keyup Control_L");
  viewed.press("2");  // nothing is shown of a picture in which the number is taken up, so the test goes on by its effects
  viewed.press("period");
  viewed.press("5");
  viewed.press("Return");
  const ReadJson typed = viewed.await([](const ReadJson& line) { return line["speed"] == 2.5; });
  CHECK(typed["step"] == 0);
  viewed.press("period");
  viewed.await(step_is(1));
}

TEST_CASE("a widget that is held when the panel goes is let go by the mouse, whether the panel is back or not", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.press("Tab");
  const ReadJson before = viewed.await([](const ReadJson& line) { return line["panel"].get<bool>(); });
  viewed.xdotool(viewed.move_to(speed_slider) + "mousedown 1");
  const ReadJson pressed = viewed.await([](const ReadJson& line) { return line["speed"] != 1; });
  viewed.xdotool(viewed.move_to(speed_slider + farther_right));
  const ReadJson held = viewed.await([&](const ReadJson& line) { return line["speed"] > pressed["speed"].get<double>(); });
  viewed.press("Tab");
  viewed.await([](const ReadJson& line) { return !line["panel"].get<bool>(); });
  viewed.xdotool(viewed.move_to(speed_slider) + "mouseup 1 key Tab " + viewed.move_to(speed_slider + 2 * farther_right));
  for (std::uint64_t step = 1; step <= 4; ++step) {  // a few pictures
    viewed.press("period");
    const ReadJson after = viewed.await(step_is(step));
    CHECK(after["panel"].get<bool>());
    CHECK(after["speed"] == held["speed"]);
    CHECK(after["camera"] == before["camera"]);
  }
}

TEST_CASE("what was told of a breakdown is gone when the panel goes back to the start", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(
      display, folder, "cpu",
      {"--set", "simulation.time_step=1e30", "--set", "collision.response=reflect", "--set", "body.body1.stretch=[0.8, 1, 1]"});
  viewed.press("Tab");
  viewed.await([](const ReadJson& line) { return line["panel"].get<bool>(); });
  viewed.press("period");
  CHECK_THAT(viewed.await(step_is(1))["message"].get<std::string>(), Catch::Contains("non-finite"));
  viewed.click(reset_button);
  const ReadJson restarted = viewed.await(step_is(0));
  CHECK(restarted["message"] == "");
  CHECK(restarted["title"] == "Small - pliant (paused at 0 s)");
}

TEST_CASE("what happens over the help leaves the scene alone, and beside it does not", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu", {"--set", "output.size=[800, 300]"});
  viewed.press("Tab");
  viewed.await([](const ReadJson& line) { return line["panel"].get<bool>(); });
  viewed.press("Tab");
  viewed.press("F1");
  const ReadJson before =
      viewed.await([](const ReadJson& line) { return !line["panel"].get<bool>() && line["help"].get<bool>(); });
  viewed.drag(1, {700, 100}, {650, 120});
  viewed.xdotool("click 5");
  viewed.drag(1, {60, 100}, {260, 100});  // where the panel was, by a quarter of the width
  viewed.await([&](const ReadJson& line) { return has_turned_by_a_quarter(before, line); });
}

TEST_CASE("on a dense display the panel is larger", "[gl][long]") {
  if (is_skipped()) return;
  const VirtualDisplay display;
  display.make_dense();
  const ScratchFolder folder;
  Viewed viewed(display, folder, "cpu");
  viewed.press("Tab");
  const ReadJson before = viewed.await([](const ReadJson& line) { return line["panel"].get<bool>(); });
  CHECK(before["size"] == std::vector<ReadJson>{640, 480});
  viewed.click(2 * step_button);
  viewed.await(step_is(1));
}

}  // namespace
