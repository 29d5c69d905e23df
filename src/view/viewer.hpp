// Shows a session in a window: events in, pictures out.
#pragma once
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "device/device.hpp"
#include "gl/objects.hpp"
#include "gl/window.hpp"
#include "render/frame_renderer.hpp"
#include "view/playback.hpp"
#include "view/session.hpp"

namespace pliant::view {

struct ViewerOptions {
  Pace pace;
  bool starts_paused = false;
  std::filesystem::path report;  // gets a line of JSON for each picture; empty: none
};

/// What keys and mouse do, as text.
[[nodiscard]] std::string help();

class Viewer {
 public:
  /// Window and device must outlive it; a GPU device runs in the window's context. Throws Error.
  Viewer(gl::Window& window, Device& device, SceneDescription scene, const ViewerOptions& options);
  ~Viewer();

  /// Until the window is closed. What a user's wish leads to that can't be is told on standard error and in the title; only a
  /// device that fails throws Error.
  void run();

 private:
  void open(SceneDescription scene);
  [[nodiscard]] std::vector<gl::WindowEvent> next_events();
  void handle(const gl::KeyPressed& event);
  void handle(const gl::MouseDragged& event);
  void handle(const gl::MouseScrolled& event);
  void handle(const gl::FilesDropped& event);
  void handle(const gl::PictureNeeded&) {}
  void try_to(const std::function<void()>& wish);
  void play();
  void tell_of_non_finite();
  void step_once();
  void step_back();
  void restart();
  void frame_scene();
  void toggle_wireframe();
  void save_picture();
  void draw();
  void report();  // in the title, and in the file if there is one
  [[nodiscard]] std::string title() const;

  gl::Window& window_;
  Device& device_;
  Playback playback_;
  BatchSize batch_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<render::FrameRenderer> renderer_;
  gl::Buffer copied_positions_;  // of a device that is not the window's
  CameraDescription camera_;
  render::Fill fill_ = render::Fill::surface;
  std::string message_;  // shown in the title until the next event
  std::string shown_title_;
  std::uint64_t picture_ = 0;
  bool is_drawn_ = false;  // there is a picture to save
  std::ofstream report_;
};

}  // namespace pliant::view
