// Writes the frames of a run in the format asked for, or into a video.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "output/video.hpp"
#include "run/prepared_run.hpp"

namespace pliant {

struct FrameTargets {
  FrameFormat format = FrameFormat::none;
  std::filesystem::path folder;  // for files of that format
  std::filesystem::path video;   // file to write instead of these; empty: none
  int first = 0;                 // number of the first frame
};

class Painter;

class FrameSink {
 public:
  FrameSink(PreparedRun& run, FrameTargets targets);
  ~FrameSink();

  /// Writes `state`, the simulation's current state, as the next frame. If a video fails, it warns and drops later frames, and
  /// the run goes on.
  void write(const State& state);
  /// Call it after the last frame. Throws Error (command_line) if a video has failed.
  void close();
  /// Returns the number of frames written, plus FrameTargets::first.
  [[nodiscard]] int count() const { return count_; }

 private:
  void write_to_video();
  PreparedRun& run_;
  FrameTargets targets_;
  std::unique_ptr<Painter> painter_;
  std::unique_ptr<VideoFile> video_;
  std::optional<Error> lost_video_;  // why it ended early
  int count_;
};

}  // namespace pliant
