// Writes the frames of a run in the format asked for.
#pragma once
#include <filesystem>
#include <memory>

#include "app/prepared_run.hpp"

namespace pliant::app {

class FrameSink {
 public:
  /// Frames are numbered from `first` on.
  FrameSink(PreparedRun& run, FrameFormat format, std::filesystem::path folder, int first = 0);
  ~FrameSink();

  /// Writes the state as it stands as the next frame.
  void write(const State& state);
  /// Of all frames, those before the first one too.
  [[nodiscard]] int count() const { return count_; }

 private:
  class Painter;
  PreparedRun& run_;
  FrameFormat format_;
  std::filesystem::path folder_;
  std::unique_ptr<Painter> painter_;
  int count_;
};

}  // namespace pliant::app
