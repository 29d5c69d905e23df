// The page that the viewer opens with when no scene is named: a picture of each demo, to be clicked.
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "device/device.hpp"
#include "view/demos.hpp"
#include "window/window.hpp"

namespace pliant::view {

/// Draws the demos' starts one after the other, and measures how fast each goes on the device. There may be no panel beside it.
class StartPage {
 public:
  /// Both must outlive the page. A GPU device must run in the window's context.
  StartPage(Window& window, Device& device, std::vector<Demo> demos);
  ~StartPage();
  StartPage(const StartPage&) = delete;
  StartPage& operator=(const StartPage&) = delete;

  /// Runs until a demo is chosen by a click or a scene is dropped, and returns it. Returns nothing if the window is closed.
  /// `tell` gets the number of pictures that are drawn, for each picture of the page.
  [[nodiscard]] std::optional<std::filesystem::path> choose(const std::function<void(std::size_t)>& tell);

 private:
  struct Entry;
  void handle(const WindowEvent& event);
  void choose_file(const std::filesystem::path& file);
  void prepare_next();
  void draw();
  void draw_entry(Entry& entry, float width);

  Window& window_;
  Device& device_;
  std::vector<std::unique_ptr<Entry>> entries_;
  std::size_t prepared_ = 0;
  std::optional<std::filesystem::path> chosen_;
  std::string message_;  // why a file can't be opened
};

}  // namespace pliant::view
