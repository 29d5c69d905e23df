// Shows a session in a window. It takes events and draws pictures.
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
  std::function<std::unique_ptr<Device>(DeviceKind kind)> make_device;  // with the same precision
  bool starts_paused = false;
  std::filesystem::path report;  // gets a line of JSON for each picture; empty: none
};

class Viewer {
 public:
  /// Returns a text that says what keys and mouse do.
  [[nodiscard]] static std::string help();

  /// The window must outlive the viewer. A GPU device must run in its context. Throws Error.
  Viewer(Window& window, std::unique_ptr<Device> device, LoadedScene scene, const ViewerOptions& options);

  /// Runs until the window is closed. If a user's wish can't be fulfilled, it says so on standard error and in the title. It
  /// throws Error only if a device fails.
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
  void throw_ball();
  void remove_body();
  void shake();
  void toggle_hand();
  [[nodiscard]] Ray ray_at_mouse() const;
  void lead_hand();
  void frame_scene();
  void toggle_wireframe();
  void toggle_panel();
  void toggle_help();
  void toggle(bool& is_shown);  // the panel or the help
  void save_picture();
  void save_scene();
  void say_saved(const std::filesystem::path& name);
  void close();
  void open_file(const std::filesystem::path& file);
  [[nodiscard]] bool is_on_gpu() const { return device_->info().kind == DeviceKind::gpu; }
  [[nodiscard]] bool is_overlaid() const { return shows_panel_ || shows_help_; }
  [[nodiscard]] Look look() const;
  void draw();
  void present(const glm::uvec2& size);
  void draw_panel(const glm::uvec2& size, double seconds);
  [[nodiscard]] Facts facts() const;
  [[nodiscard]] Wishes wishes() const;  // the current values
  void fulfil();
  void change(const Settings& wanted);
  void tell();  // sets the title and adds to the report
  [[nodiscard]] std::string title() const;

  Window& window_;
  std::unique_ptr<Device> device_;
  std::function<std::unique_ptr<Device>(DeviceKind)> make_device_;
  Playback playback_;
  BatchSize batch_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<SceneView> view_;
  CameraDescription camera_;
  Shows shows_;
  std::unique_ptr<Panel> panel_;  // made when the panel or the help is first shown
  bool shows_panel_ = false, shows_help_ = false;
  Observer observer_;
  std::deque<WindowEvent> events_;             // not handled yet
  std::vector<std::filesystem::path> scenes_;  // in the folder of the one that is shown
  glm::dvec3 pulled_from_{0.0};                // where the vertex was picked [m]
  glm::dvec2 mouse_{0.0};                      // its latest place [pixels]
  double hand_distance_ = 0;                   // of the hand before the eye [m]
  std::string message_;                        // cleared by the next key or wish, except those for the panel and the help
  bool is_breakdown_told_ = false;
  std::string shown_title_;
  std::uint64_t picture_ = 0;
  double recorded_at_ = 0;                         // when the latest state was recorded [s]
  bool has_repeated_ = false;                      // a held key has had its effect since the latest picture
  bool is_up_to_date_ = false;                     // the window showed the wanted look already
  std::optional<Look> shown_;                      // what the window shows; empty: it must be shown again
  std::optional<Wishes> wanted_;                   // from the panel in the latest picture; empty: fulfilled, or no panel
  double presented_at_ = 0, picture_seconds_ = 0;  // time of the latest picture, and mean time between pictures [s]
  int owed_pictures_ = 0;                          // to draw until the panel has followed an event
  bool times_passes_ = false;
  std::ofstream report_;
};

}  // namespace pliant::view
