// Shows a session in a window: events in, pictures out.
#pragma once
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "device/device.hpp"
#include "view/observer.hpp"
#include "view/pick.hpp"
#include "view/playback.hpp"
#include "view/scene_view.hpp"
#include "view/session.hpp"
#include "window/panel.hpp"
#include "window/window.hpp"

namespace pliant::view {

struct ViewerOptions {
  Pace pace;
  std::function<std::unique_ptr<Device>(std::string_view kind)> make_device;  // "cpu" or "gpu", of the same precision
  bool starts_paused = false;
  std::filesystem::path report;  // gets a line of JSON for each picture; empty: none
};

class Viewer {
 public:
  /// What keys and mouse do, as text.
  [[nodiscard]] static std::string help();

  /// The window must outlive it; a GPU device runs in its context. Throws Error.
  Viewer(Window& window, std::unique_ptr<Device> device, LoadedScene scene, const ViewerOptions& options);

  /// Until the window is closed. What a user's wish leads to that can't be is told on standard error and in the title; only a
  /// device that fails throws Error.
  void run();

 private:
  struct Command;
  /// The one list of keys.
  [[nodiscard]] static std::span<const Command> commands();

  void open(LoadedScene scene);
  void await_events();
  void handle_events();
  void handle(const KeyPressed& event);
  void handle(const MousePressed& event);
  void handle(const MouseReleased& event);
  void handle(const MouseMoved& event);
  void handle(const MouseScrolled& event);
  void handle(const FilesDropped& event);
  void handle(const PictureNeeded&) { shown_.reset(); }
  void try_to(const std::function<void()>& wish);
  void play();
  void tell_if_broken();
  void pause_or_go_on();
  void step_once();
  void step_back();
  void restart();
  void switch_device();
  void frame_scene();
  void toggle_wireframe();
  void toggle_panel();
  void toggle_help();
  void toggle(bool& is_shown);  // one of the two
  void save_picture();
  void close();
  void open_file(const std::filesystem::path& file);
  [[nodiscard]] bool is_overlaid() const { return shows_panel_ || shows_help_; }
  [[nodiscard]] Look look() const;
  void draw();
  void present(const glm::uvec2& size);
  void draw_panel(const glm::uvec2& size, double seconds);
  [[nodiscard]] Facts facts() const;
  [[nodiscard]] Wishes wishes() const;  // that are fulfilled
  void fulfil();
  void change(const Settings& wanted);
  void tell();  // in the title, and in the report if there is one
  [[nodiscard]] std::string title() const;

  Window& window_;
  std::unique_ptr<Device> device_;
  std::function<std::unique_ptr<Device>(std::string_view)> make_device_;
  Playback playback_;
  BatchSize batch_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<SceneView> view_;
  CameraDescription camera_;
  Shows shows_;
  std::unique_ptr<Panel> panel_;  // once it has been asked for
  bool shows_panel_ = false, shows_help_ = false;
  Observer observer_;
  std::deque<WindowEvent> events_;             // not handled yet
  std::vector<std::filesystem::path> scenes_;  // beside the one that is shown
  std::optional<Pull> pull_;
  glm::dvec3 pulled_from_{0.0};  // where the picked vertex was [m]
  std::string message_;          // until the next key or wish, but those that show or hide the panel
  bool is_breakdown_told_ = false;
  std::string shown_title_;
  std::uint64_t picture_ = 0;
  double recorded_at_ = 0;                         // the latest state to go back to [s]
  bool has_repeated_ = false;                      // a key that is held has done its work since the latest picture
  bool is_up_to_date_ = false;                     // there was nothing to draw anew
  std::optional<Look> shown_;                      // what the window shows; empty: it is to be shown again
  std::optional<Wishes> wanted_;                   // in the latest picture, if it had the panel and they are not fulfilled
  double presented_at_ = 0, picture_seconds_ = 0;  // between pictures, on average [s]
  int owed_pictures_ = 0;                          // for the panel to follow what it was done to
  bool times_passes_ = false;
  std::ofstream report_;
};

}  // namespace pliant::view
