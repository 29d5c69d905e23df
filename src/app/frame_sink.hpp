// Writes the frames of a run in the format asked for, or into a video.
#pragma once
#include <filesystem>
#include <memory>

#include "app/prepared_run.hpp"
#include "output/video.hpp"

namespace pliant::app {

struct FrameTargets {
  FrameFormat format = FrameFormat::none;
  std::filesystem::path folder;  // of files of that format
  std::filesystem::path video;   // a file instead of these; empty: none
  int first = 0;                 // number of the first frame
};

class FrameSink {
 public:
  FrameSink(PreparedRun& run, FrameTargets targets);
  ~FrameSink();

  /// Writes the state as it stands as the next frame.
  void write(const State& state);
  /// After the last frame. Without it a video's failure at its end goes unnoticed. Throws Error (command_line).
  void close();
  /// Of all frames, those before the first one too.
  [[nodiscard]] int count() const { return count_; }

 private:
  class Painter;
  PreparedRun& run_;
  FrameTargets targets_;
  std::unique_ptr<Painter> painter_;
  std::unique_ptr<VideoFile> video_;
  int count_;
};

}  // namespace pliant::app
