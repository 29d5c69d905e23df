// A script in ffmpeg's place shows what ffmpeg is told and given. If there is an ffmpeg, its own output is tested, too.
#include "output/video.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cstdio>

#include "core/read_text.hpp"
#include "support/expect_error.hpp"
#include "support/has.hpp"
#include "support/scratch.hpp"
#include "support/stand_in.hpp"

namespace pliant {
namespace {

using test::ScratchFolder;
using test::StandIn;

render::Image picture(std::uint8_t value) { return {6, 4, std::vector<std::uint8_t>(72, value)}; }

// A script that writes its arguments and its input beside itself.
const std::string recorder = "printf '%s\\n' \"$@\" > \"$0.arguments\"\ncat > \"$0.input\"\n";

TEST_CASE("ffmpeg is given every picture's bytes in order, their size and rate, and the file's place") {
  const ScratchFolder folder;
  const StandIn ffmpeg(folder.path / "bin", "ffmpeg", recorder);
  CHECK(VideoFile::has_encoder());
  VideoFile video(folder.path / "new" / "a b.mp4", {6, 4, 29.5});
  for (const int value : {1, 2, 3}) video.write(picture(static_cast<std::uint8_t>(value)));
  video.close();
  CHECK(read_text(folder.path / "bin/ffmpeg.input") == std::string(72, '\1') + std::string(72, '\2') + std::string(72, '\3'));
  const std::string arguments = read_text(folder.path / "bin/ffmpeg.arguments");
  for (const char* part : {"-f\nrawvideo\n", "-pixel_format\nrgb24\n", "-video_size\n6x4\n", "-framerate\n29.5\n", "-i\npipe:0\n",
                           "-c:v\nlibx264\n", "-pix_fmt\nyuv420p\n"})
    CHECK_THAT(arguments, Catch::Contains(part));
  CHECK(arguments.ends_with("\nfile:" + (folder.path / "new" / "a b.mp4").string() + "\n"));
}

TEST_CASE("an ffmpeg that fails is an error with its last lines, at once or at the end") {
  const ScratchFolder folder;
  const std::string complaint = "echo first >&2\necho no such codec >&2\nexit 1\n";
  {
    const StandIn ffmpeg(folder.path / "bin", "ffmpeg", "cat > /dev/null\n" + complaint);
    VideoFile video(folder.path / "a.mp4", {6, 4, 60});
    video.write(picture(1));
    check_says(error_of([&] { video.close(); }), {"a.mp4", "ffmpeg failed: first | no such codec", "--frames png"});
  }
  const StandIn ffmpeg(folder.path / "bin", "ffmpeg", complaint);
  VideoFile video(folder.path / "a.mp4", {6, 4, 60});
  const Error error = error_of([&] {
    for (;;) video.write(picture(1));
  });
  CHECK(error.kind() == ErrorKind::command_line);
  check_says(error, {"a.mp4", "ffmpeg failed: first | no such codec"});
}

// A line for each property of the video, with its value.
std::string probed(const std::filesystem::path& video) {
  const std::string entries = "codec_name,width,height,pix_fmt,color_range,color_space,r_frame_rate,nb_read_frames";
  const std::string command =
      "ffprobe -v error -count_frames -of default=noprint_wrappers=1 -show_entries stream=" + entries + " " + video.string();
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string lines;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) lines += static_cast<char>(c);
  CHECK(pclose(pipe) == 0);
  return lines;
}

TEST_CASE("the ffmpeg that is installed makes a video of every picture, with even sizes, in every container") {
  if (test::lacks("ffmpeg", VideoFile::has_encoder()) || test::lacks("ffprobe", find_program("ffprobe").has_value())) return;
  const ScratchFolder folder;
  for (const std::string name : {"a.mp4", "a.mkv", "a.mov"}) {
    VideoFile video(folder.path / name, {7, 5, 50});
    for (const int value : {0, 100, 200}) video.write({7, 5, std::vector<std::uint8_t>(105, static_cast<std::uint8_t>(value))});
    video.close();
    CAPTURE(name);
    CHECK(probed(folder.path / name) ==
          "codec_name=h264\nwidth=8\nheight=6\npix_fmt=yuv420p\ncolor_range=tv\ncolor_space=bt709\n"
          "r_frame_rate=50/1\nnb_read_frames=3\n");
  }
}

TEST_CASE("a video in a place that can't be written is an error before ffmpeg is started") {
  const ScratchFolder folder;
  const StandIn ffmpeg(folder.path / "bin", "ffmpeg", recorder);
  CHECK(error_of([&] { VideoFile(folder.path, {6, 4, 60}); }).kind() == ErrorKind::command_line);
  CHECK(error_of([&] { VideoFile("/dev/null/a.mp4", {6, 4, 60}); }).kind() == ErrorKind::command_line);
}

TEST_CASE("a pipe is no place for a video, and is an error before ffmpeg is started") {
  const ScratchFolder folder;
  const StandIn ffmpeg(folder.path / "bin", "ffmpeg", recorder);
  const auto pipe = folder.path / "a.mp4";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const Error error = error_of([&] { VideoFile(pipe, {6, 4, 60}); });
  CHECK(error.kind() == ErrorKind::command_line);
  check_says(error, {"a.mp4", "is no plain file"});
  CHECK_FALSE(std::filesystem::exists(folder.path / "bin/ffmpeg.arguments"));
}

TEST_CASE("a video's ending names a container for H.264, and any other is an error that leaves no file") {
  const ScratchFolder folder;
  const StandIn ffmpeg(folder.path / "bin", "ffmpeg", recorder);
  for (const char* name : {"a.mp4", "a.MKV", "a.b.mov"}) CHECK_NOTHROW(VideoFile(folder.path / name, {6, 4, 60}));
  for (const char* name : {"a.gif", "a.webm", "mp4", ".mp4"}) {
    const Error error = error_of([&] { VideoFile(folder.path / name, {6, 4, 60}); });
    CHECK(error.kind() == ErrorKind::command_line);
    check_says(error, {name, ".mp4, .mkv or .mov"});
    CHECK_FALSE(std::filesystem::exists(folder.path / name));
  }
}

}  // namespace
}  // namespace pliant
