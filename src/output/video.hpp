// Writes a video of a run's frames. ffmpeg encodes it while the run goes on.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

#include "output/program_pipe.hpp"
#include "render/image.hpp"

namespace pliant {

struct VideoFormat {
  std::uint32_t width = 0, height = 0;  // [pixels]
  double frame_rate = 60;               // [1/s]
};

class VideoFile {
 public:
  /// Returns whether ffmpeg is on PATH.
  [[nodiscard]] static bool has_encoder();

  /// Writes H.264 into the container that the path's ending names: mp4, mkv or mov. Makes missing folders and replaces an
  /// existing file. Throws Error (command_line) for another ending, if the file can't be written or is not a plain file, or if
  /// ffmpeg can't be started.
  VideoFile(const std::filesystem::path& path, const VideoFormat& format);

  /// Adds a picture. Expects one of the format's size. If ffmpeg takes no more, it throws Error (command_line) with ffmpeg's last
  /// lines.
  void write(const render::Image& image);
  /// Waits until ffmpeg is done and the file is whole. Throws as write() does. Without this call the destructor waits, but a
  /// failure goes unnoticed.
  void close();

 private:
  std::filesystem::path path_;
  VideoFormat format_;
  std::optional<ProgramPipe> encoder_;
};

}  // namespace pliant
