// `pliant view`: shows a scene live in a window.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "run/choose_device.hpp"

namespace pliant::app {

struct ViewOptions {
  std::filesystem::path scene;         // or an OBJ file; empty: a start page lets its user choose a demo
  DeviceChoice device;                 // its GPU is the window's
  std::vector<std::string> overrides;  // section.key=value
  double speed = 1;                    // simulated time in a second of real time [s]
  bool starts_paused = false;
  std::filesystem::path report;  // gets a line of JSON for each picture; empty: none
};

/// Returns when the window is closed. Throws Error. Its kind is device if there is no display, or if this program was built
/// without the viewer.
void view(const ViewOptions& options);

/// Returns a text that says what keys and mouse do.
[[nodiscard]] std::string view_help();

}  // namespace pliant::app
