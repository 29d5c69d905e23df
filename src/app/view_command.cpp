#include "app/view_command.hpp"

#include "core/error.hpp"
#ifdef PLIANT_VIEWER
#include "view/viewer.hpp"
#endif

namespace pliant::app {

#ifdef PLIANT_VIEWER

// The scene is read first: a mistake in it shall not need a display to be seen.
void view(const ViewOptions& options) {
  const SceneDescription scene = view::describe(options.scene, options.overrides);
  gl::Window window(scene.output.size, scene.title);
  const std::unique_ptr<Device> device = choose_device(options.device, window.context());
  view::Viewer viewer(window, *device, scene,
                      {.pace = {.speed = options.speed}, .starts_paused = options.starts_paused, .report = options.report});
  viewer.run();
}

#else

void view(const ViewOptions&) {
  throw Error(ErrorKind::device, "", "this pliant was built without the viewer",
              "build it where GLFW is installed (Debian: libglfw3-dev), or draw by `pliant run SCENE --frames png`");
}

#endif

}  // namespace pliant::app
