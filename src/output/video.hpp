// A video of a run's frames, encoded by ffmpeg while the run goes on.
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
  /// Whether ffmpeg is there, on PATH.
  [[nodiscard]] static bool has_encoder();

  /// H.264 in the container that the path's ending names: mp4, mkv or mov. Creates the folders that are missing, and replaces
  /// an existing file. Throws Error (command_line) for another ending, where the file can't be written or is no plain one, or
  /// ffmpeg can't be started.
  VideoFile(const std::filesystem::path& path, const VideoFormat& format);

  /// Expects a picture of the format's size. Throws Error (command_line), with ffmpeg's last lines, when it takes no more.
  void write(const render::Image& image);
  /// Waits until ffmpeg is done; before that, the file may not be whole. Throws as write() does. Without it the file becomes
  /// whole when the VideoFile goes, but a failure goes unnoticed.
  void close();

 private:
  std::filesystem::path path_;
  VideoFormat format_;
  std::optional<ProgramPipe> encoder_;
};

}  // namespace pliant
