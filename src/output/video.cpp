// Sends raw pictures to ffmpeg through a pipe. See ffmpeg(1) and https://trac.ffmpeg.org/wiki/Encode/H.264.
#include "output/video.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/expect.hpp"
#include "core/extension.hpp"
#include "output/file.hpp"

namespace pliant {
namespace {

Error failed(const std::filesystem::path& path, const ProgramPipe::End& end) {
  return {ErrorKind::command_line, path.string(), "ffmpeg failed: " + end.account, "fix that, or use --frames png instead"};
}

// Other containers that ffmpeg knows can't hold H.264, or not well. ffmpeg says so only after it has begun the file.
void expect_container(const std::filesystem::path& path) {
  for (const char* known : {".mp4", ".mkv", ".mov"})
    if (extension_of(path) == known) return;
  throw Error(ErrorKind::command_line, path.string(), "has an ending that stands for no container of H.264 video",
              "name it .mp4, .mkv or .mov");
}

std::filesystem::path encoder() {
  if (const auto program = find_program("ffmpeg")) return *program;
  throw Error(ErrorKind::command_line, "--video", "there is no ffmpeg on PATH", "install it, or use --frames png instead");
}

// Every player knows yuv420p, which needs even sizes. The colours are labelled as sRGB, because players otherwise guess them from
// the size. With "file:" ffmpeg takes names with colons or a leading dash for files.
std::vector<std::string> arguments_for(const std::filesystem::path& path, const VideoFormat& format) {
  return {"-hide_banner",
          "-nostdin",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pixel_format",
          "rgb24",
          "-video_size",
          fmt::format("{}x{}", format.width, format.height),
          "-framerate",
          fmt::format("{}", format.frame_rate),
          "-i",
          "pipe:0",
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "iec61966-2-1",
          "-color_range",
          "tv",
          "-c:v",
          "libx264",
          "-preset",
          "medium",
          "-crf",
          "18",
          "-pix_fmt",
          "yuv420p",
          "-movflags",
          "+faststart",
          "file:" + path.string()};
}

}  // namespace

bool VideoFile::has_encoder() { return find_program("ffmpeg").has_value(); }

VideoFile::VideoFile(const std::filesystem::path& path, const VideoFormat& format) : path_(path), format_(format) {
  expect_container(path);
  expect_plain_or_none(path);
  expect_writable(path);
  encoder_.emplace(encoder(), arguments_for(path, format));
}

void VideoFile::write(const render::Image& image) {
  PLIANT_EXPECT(image.width == format_.width && image.height == format_.height);
  PLIANT_EXPECT(image.pixels.size() == std::size_t{3} * image.width * image.height);
  if (encoder_->write(std::as_bytes(std::span(image.pixels)))) return;
  const ProgramPipe::End end = encoder_->finish();
  encoder_.reset();
  throw failed(path_, end);
}

void VideoFile::close() {
  const ProgramPipe::End end = encoder_->finish();
  encoder_.reset();
  if (!end.succeeded) throw failed(path_, end);
}

}  // namespace pliant
