#include "app/view_command.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "core/error.hpp"
#include "device/gpu/gpu_device.hpp"
#ifdef PLIANT_VIEWER
#include "window/viewer.hpp"
#endif

namespace pliant::app {

#ifdef PLIANT_VIEWER

// Checks options and scene first, so that mistakes in them are reported even without a display.
void view(const ViewOptions& options) {
  expect_consistent(options.device);
  view::LoadedScene scene = view::load(options.scene, options.overrides);
  for (const std::string& warning : scene.warnings) fmt::print(stderr, "pliant: warning: {}\n", warning);
  static_cast<void>(plan_time(scene.description, scene.start.model));
  view::Window window(scene.description.output.size, scene.description.title);
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
