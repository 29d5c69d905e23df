// The suite `draw` measures the GPU time of a picture and of its passes, for the start of every scene of a folder. It draws as
// the viewer does. It also measures what pictures cost a simulation that goes on.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/common/place.hpp"

namespace pliant::bench {

struct DrawOptions {
  int gpu_index = 0;                        // of gl::list_adapters()
  std::filesystem::path scenes = "scenes";  // folder of scenes
  glm::uvec2 size{1920, 1080};              // of the picture [pixels]
  bool quick = false;
};

/// Returns the share of its steps per second that a scene loses to 60 pictures a second. The arguments are the times of the same
/// steps with and without a picture [s].
[[nodiscard]] double share_lost(double seconds_with_picture, double seconds_without);

/// A scene that was played as the viewer does, by its clock, on a display of 60 pictures a second.
struct Played {
  std::uint32_t pictures = 0;
  std::uint32_t late = 0;                   // that took longer than a sixtieth of a second
  double seconds_dropped = 0;               // of simulated time, because steps took too long
  double simulation_milliseconds = 0;       // mean over pictures
  double drawing_milliseconds = 0;          // the same
  double slowest_picture_milliseconds = 0;  // of both together
};

/// The members' names are the keys of the file. A pass `shadow` has the key `shadow_milliseconds`.
struct DrawRow {
  std::string scene;
  std::uint32_t vertices = 0;  // of all bodies
  std::uint32_t triangles = 0;
  std::uint32_t bodies = 0;
  std::uint32_t clustered_bodies = 0;         // whose springs are summed by clusters
  std::string detail = "full";                // or "reduced" if software draws
  std::uint32_t width = 0, height = 0;        // [pixels]
  double milliseconds_per_frame = 0;          // the median over batches, by the GPU's clock
  double fastest_milliseconds_per_frame = 0;  // the fastest batch
  /// share_lost of steps from the start. It is empty if the measurement is quick, if a picture or a step alone takes longer than
  /// a sixtieth of a second, or if steps became non-finite.
  std::optional<double> steps_lost;
  std::optional<Played> played;                              // empty if the measurement is quick, or by a tolerance
  std::vector<std::pair<std::string, double>> milliseconds;  // median of each pass over frames with a mark after each pass
};

struct DrawResult {
  std::vector<DrawRow> rows;
  std::vector<std::string> notes;  // what was left out, and why
  bool interrupted = false;        // by Progress
};

/// Draws from the simulation's own buffers and reads nothing back. Throws Error.
[[nodiscard]] DrawResult bench_draw(const DrawOptions& options, const Progress& progress);

}  // namespace pliant::bench
