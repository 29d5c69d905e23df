#include "app/view_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "core/json.hpp"
#include "device/gpu/gpu_device.hpp"
#ifdef PLIANT_VIEWER
#include "view/demos.hpp"
#include "window/start_page.hpp"
#include "window/viewer.hpp"
#endif

namespace pliant::app {

#ifdef PLIANT_VIEWER

void view_in(view::Window& window, const ViewOptions& options, view::LoadedScene scene) {
  std::unique_ptr<Device> device = choose_device(options.device, window.context());
  const auto make_device = [&](DeviceKind kind) {
    return kind == DeviceKind::gpu ? make_gpu_device(window.context())
                                   : make_cpu_device(options.device.threads, options.device.precision.value_or(32));
  };
  view::Viewer viewer(window, std::move(device), std::move(scene),
                      {.pace = {.speed = options.speed},
                       .make_device = make_device,
                       .starts_paused = options.starts_paused,
                       .report = options.report});
  viewer.run();
}

// Shows the start page until its user chooses a demo, or closes the window.
std::optional<std::filesystem::path> choose_demo(view::Window& window, Device& device, std::vector<view::Demo> demos,
                                                 const std::filesystem::path& report_file) {
  view::StartPage page(window, device, std::move(demos));
  std::ofstream report;
  if (!report_file.empty()) report.open(report_file, std::ios::app);
  return page.choose([&](std::size_t pictures) {
    if (report.is_open()) report << Json{{"start_page", pictures}}.text() << std::endl;
  });
}

void view_demos(const ViewOptions& options) {
  if (!options.overrides.empty())
    throw Error(ErrorKind::command_line, "--set", "there is no scene to set it in",
                "name one, as in pliant view SCENE --set ...");
  std::vector<view::Demo> demos = view::find_demos(view::demo_folder());
  view::Window window({1180, 760}, "pliant");
  ViewOptions chosen = options;
  {
    const std::unique_ptr<Device> device = choose_device(options.device, window.context());
    const std::optional<std::filesystem::path> scene = choose_demo(window, *device, std::move(demos), options.report);
    if (!scene) return;
    chosen.scene = *scene;
  }
  view_in(window, chosen, view::load(chosen.scene));
}

// Checks options and scene first, so that mistakes in them are reported even without a display.
void view(const ViewOptions& options) {
  expect_consistent(options.device);
  if (options.scene.empty()) return view_demos(options);
  view::LoadedScene scene = view::load(options.scene, options.overrides);
  for (const std::string& warning : scene.warnings) fmt::print(stderr, "pliant: warning: {}\n", warning);
  static_cast<void>(plan_time(scene.description, scene.start.model));
  view::Window window(scene.description.output.size, scene.description.title);
  view_in(window, options, std::move(scene));
}

std::string view_help() { return "In the window:\n" + view::Viewer::help(); }

#else

std::string view_help() { return "This pliant was built without the viewer.\n"; }

void view(const ViewOptions&) {
  throw Error(ErrorKind::device, "", "this pliant was built without the viewer",
              "build it where GLFW and Dear ImGui are installed (Debian: libglfw3-dev, libimgui-dev), or draw by `pliant run "
              "SCENE --frames png`");
}

#endif

}  // namespace pliant::app
