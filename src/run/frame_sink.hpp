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
  std::filesystem::path folder;  // of files of that format
  std::filesystem::path video;   // a file instead of these; empty: none
  int first = 0;                 // number of the first frame
};

/// "1 frame", "2 frames".
[[nodiscard]] std::string counted(int count, const char* thing);

class FrameSink {
 public:
  FrameSink(PreparedRun& run, FrameTargets targets);
  ~FrameSink();

  /// Writes the state as it stands as the next frame. A video that fails costs no run: a warning tells of it, and later frames
  /// go nowhere.
  void write(const State& state);
  /// After the last frame. Throws Error (command_line) where a video failed, on the way or at its end.
  void close();
  /// Of all frames, those before the first one too.
  [[nodiscard]] int count() const { return count_; }

 private:
  class Painter;
  void write_to_video();
  PreparedRun& run_;
  FrameTargets targets_;
  std::unique_ptr<Painter> painter_;
  std::unique_ptr<VideoFile> video_;
  std::optional<Error> lost_video_;  // why it ended early
  int count_;
};

}  // namespace pliant
