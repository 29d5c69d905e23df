// The panel beside the scene. It shows facts and edits wishes, which the viewer fulfils.
#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene_description.hpp"
#include "view/look.hpp"
#include "view/observer.hpp"
#include "window/window.hpp"

namespace pliant::view {

/// The values that the panel can change. It changes nothing else.
struct Wishes {
  bool is_paused = false, times_passes = false, is_on_gpu = false;
  double speed = 1;
  Settings settings;
  Shows shows;
  std::optional<std::filesystem::path> scene;  // to be opened
  bool restarts = false, steps = false, steps_back = false, saves_scene = false;

  bool operator==(const Wishes&) const = default;
};

/// The values that the panel shows.
struct Facts {
  std::string title, device, message;
  std::vector<std::filesystem::path> scenes;  // to choose from
  std::filesystem::path scene;
  std::vector<std::string> bodies;
  std::uint64_t step = 0, vertices = 0;
  double time = 0, time_step = 0;   // [s]
  std::optional<double> tolerance;  // empty: all steps have the length time_step
  double pictures_per_second = 0;
  double factor = 1;           // simulated time over real time
  unsigned deepest_level = 0;  // of the trees
  StepReport report;
  const Observation* observation = nullptr;
};

class Panel {
 public:
  /// Draws everything `scale` times as large as on a usual display. Needs a current gl::Context while it lives. There may be only
  /// one panel at a time.
  explicit Panel(float scale);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  /// Takes an event, and returns whether it belongs to the panel. A press over the panel's windows belongs to it, and so do moves
  /// until the release. A turn of the wheel there belongs to it, too, and keys while a number is typed. Pass it every event, even
  /// while it is hidden, but at most one press or release a picture.
  bool takes(const WindowEvent& event);
  /// Draws into the window, `seconds` after the last time. `help` is a text to show over all, or empty.
  void draw(const glm::uvec2& size, double seconds, const Facts& facts, Wishes& wishes, const std::string& help);
  /// Draws only the help.
  void draw_help(const glm::uvec2& size, double seconds, const std::string& help);
  /// Tells it that nothing is shown until it draws again.
  void hide();
  /// Returns the number of windows in the latest picture: the panel, the help, an open list.
  [[nodiscard]] std::size_t window_count() const;

 private:
  bool types(const std::string& key);
  void begin(const glm::uvec2& size, double seconds);
  void end();
  struct Mouse;
  std::unique_ptr<Mouse> mouse_;
};

}  // namespace pliant::view
